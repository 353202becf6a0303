// The page around the widget: its data stand beside it, and it is its own model.
{
  const data = JSON.parse(document.getElementById("data").textContent);
  widget.render({
    model: { get: (name) => (name === "data" ? data : undefined), on() {}, off() {} },
    el: document.getElementById("report"),
  });
}

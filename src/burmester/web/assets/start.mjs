// The page around the widget: it has its data beside it, and is its only model.
const data = JSON.parse(document.getElementById("data").textContent);
widget.render({
  model: { get: (name) => (name === "data" ? data : undefined), on() {}, off() {} },
  el: document.getElementById("report"),
});

// Keys: space plays and stops, arrows on the drawing move the driver.

const TYPED_IN = "button, select, textarea, summary, a, input[type=checkbox]"; // elements with a use of their own for space

/** Listen within a report until the signal; keys in its inputs and cards are theirs. */
export function listenToKeys(root, drawing, player, signal) {
  root.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !player.path) return;
    if (event.key === " " && !event.target.matches(TYPED_IN)) {
      event.preventDefault();
      player.play(!player.playing);
    } else if (event.target === drawing && /^Arrow/.test(event.key)) {
      event.preventDefault();
      const sense = event.key === "ArrowLeft" || event.key === "ArrowDown" ? -1 : 1;
      player.step(event.shiftKey ? 10 * sense : sense);
    }
  }, { signal });
  // Where nothing has the focus, space plays, too.
  document.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.target !== document.body || !player.path) return;
    event.preventDefault();
    player.play(!player.playing);
  }, { signal });
}

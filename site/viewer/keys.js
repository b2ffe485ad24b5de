// What keys do, in one table: the viewer acts by it, and the help that ? opens lists it.
(function () {
  "use strict";

  const keys = [
    ["1", "Side by side: technique, truth, difference", (act) => act.mode("side")],
    ["2", "Slider between technique and truth", (act) => act.mode("slider")],
    ["3", "Flicker between technique and truth in place", (act) => act.mode("flicker")],
    ["4", "Difference alone", (act) => act.mode("difference")],
    ["5", "Frames of the sequence, with the flicker map", (act) => act.mode("frames")],
    ["Space", "Flicker: the other picture, and stop; frames: play or stop", (act) => act.flip()],
    ["Arrows", "Choose the next pixel that way; with Shift the tenth", null],
    ["n", "Next worst pixel", (act) => act.worst(1)],
    ["p", "Previous worst pixel", (act) => act.worst(-1)],
    ["+", "Zoom in", (act) => act.zoom(2)],
    ["-", "Zoom out", (act) => act.zoom(0.5)],
    ["0", "Whole image", (act) => act.zoom(0)],
    ["]", "Next technique, same place", (act) => act.technique(1)],
    ["[", "Previous technique, same place", (act) => act.technique(-1)],
    ["t", "Next truth to compare with", (act) => act.truth()],
    ["<", "Move the slider to the left", (act) => act.split(-0.05)],
    [">", "Move the slider to the right", (act) => act.split(0.05)],
    [",", "Previous frame of the sequence", (act) => act.frame(-1)],
    [".", "Next frame of the sequence", (act) => act.frame(1)],
    ["g", "Scale of the difference: ±1, ±1/4, ±1/16", (act) => act.gain()],
    ["s", "Shaded pictures of the scene, or visibility", (act) => act.shaded()],
    ["e", "Shadow edges on or off", (act) => act.edges()],
    ["?", "This list", (act) => act.help()],
  ];
  const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const alias = { " ": "Space", "=": "+", _: "-" };

  // An input of one's own for the key: nothing is taken from a field that one writes in or chooses from.
  function belongsToField(event) {
    const field = event.target.closest ? event.target.closest("input, select, textarea, dialog") : null;
    if (!field) return false;
    const isSwitch = field.type === "radio" || field.type === "checkbox" || field.type === "range";
    return !isSwitch || event.key in arrows || event.key === " ";
  }

  function pressesButton(event) {
    return event.key === " " && event.target.closest && event.target.closest("button, a, summary");
  }

  // Does what a key is for; false where it is for nothing here.
  shadowbench.actOnKey = function (event, act) {
    if (event.ctrlKey || event.metaKey || event.altKey || belongsToField(event) || pressesButton(event)) return false;
    if (event.key in arrows) {
      if (!act.hasFocus()) return false; // or nobody could scroll the page
      const step = event.shiftKey ? 10 : 1;
      act.move(...arrows[event.key].map((d) => d * step));
      return true;
    }
    const found = keys.find(([key]) => key === (alias[event.key] || event.key));
    if (!found || !found[2]) return false;
    found[2](act);
    return true;
  };

  shadowbench.helpDialog = function () {
    const { element } = shadowbench;
    const rows = keys.map(([key, text]) =>
      element("tr", {}, element("th", { scope: "row" }, element("kbd", {}, key)), element("td", {}, text)));
    return element("dialog", { class: "viewer-help", "aria-label": "Keys" },
      element("h2", {}, "Keys"),
      element("table", {}, element("tbody", {}, ...rows)),
      element("p", {}, "A click chooses a pixel. Dragging moves the part that is shown, or the slider. The wheel zooms with " +
        "Ctrl, or while a picture has the focus."),
      element("form", { method: "dialog" }, element("button", {}, "Close")));
  };
})();

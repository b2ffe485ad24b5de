// The viewer's controls, made of HTML's own.
(function () {
  "use strict";

  // An element with attributes and children; text is text, whatever it holds.
  shadowbench.element = function (tag, attributes, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes))
      if (value !== false) made.setAttribute(name, value === true ? "" : value);
    made.append(...children);
    return made;
  };
  const element = shadowbench.element;

  const modeNames = {
    side: "Side by side", slider: "Slider", flicker: "Flicker", difference: "Difference", frames: "Frames",
  };

  function labelled(text, field, name) {
    return element("label", name ? { "data-for": name } : {}, text + " ", field);
  }

  function button(text, label, action) {
    const made = element("button", { type: "button", "aria-label": label, title: label }, text);
    made.addEventListener("click", action);
    return made;
  }

  function techniques(catalogue) {
    return element("select", { name: "cell" },
      ...catalogue.cells.map((cell) => element("option", { value: cell.slug },
        cell.error ? cell.variant + " (" + cell.error + ")" : cell.variant)));
  }

  function others(catalogue) {
    const truths = catalogue.truths.map((truth) => element("option", { value: truth.name }, "truth, " + truth.label));
    const cells = catalogue.cells.map((cell) => element("option", { value: "cell:" + cell.slug }, cell.variant));
    return element("select", { name: "against" },
      element("optgroup", { label: "Truth" }, ...truths), element("optgroup", { label: "Another technique" }, ...cells));
  }

  function modes(act) {
    const choices = shadowbench.modes.map((mode) => {
      const radio = element("input", { type: "radio", name: "mode", value: mode });
      radio.addEventListener("change", () => act.mode(mode));
      return element("label", {}, radio, element("span", {}, modeNames[mode]));
    });
    return element("fieldset", { class: "modes" }, element("legend", {}, "View"), ...choices);
  }

  function scales() {
    return element("select", { name: "gain" }, ...[[1, "±1"], [4, "±1/4"], [16, "±1/16"]].map(([gain, text]) =>
      element("option", { value: gain }, text)));
  }

  function onInput(field, action) {
    field.addEventListener("input", () => action(field));
    return field;
  }

  function zoomButtons(act) {
    return element("span", { class: "group" }, button("−", "Zoom out", () => act.zoom(0.5)),
      button("+", "Zoom in", () => act.zoom(2)), button("Fit", "Fit: whole image", () => act.zoom(0)));
  }

  function worstButtons(act) {
    return element("span", { class: "group" }, button("‹", "Previous worst pixel", () => act.worst(-1)),
      button("Next worst ›", "Next worst pixel", () => act.worst(1)));
  }

  // A bar of controls that call `act`; `update(view, catalogue, cell)` shows a view in them.
  shadowbench.controls = function (catalogue, act) {
    const range = (name, step) => element("input", { type: "range", name, min: 0, max: 1, step });
    const fields = {
      cell: onInput(techniques(catalogue), (f) => act.change({ cell: f.value })),
      against: onInput(others(catalogue), (f) => act.change({ against: f.value })),
      gain: onInput(scales(), (f) => act.change({ gain: Number(f.value) })),
      shaded: onInput(element("input", { type: "checkbox", name: "shaded" }), (f) => act.change({ shaded: f.checked })),
      edges: onInput(element("input", { type: "checkbox", name: "edges" }), (f) => act.change({ edges: f.checked })),
      split: onInput(range("split", 0.005), (f) => act.change({ split: Number(f.value) })),
      frame: onInput(range("frame", 1), (f) => act.change({ frame: Number(f.value) })),
    };
    const play = button("Play", "Play the frames", () => act.flip());
    const bar = element("div", { class: "controls" },
      labelled("Technique", fields.cell), labelled("against", fields.against), modes(act), zoomButtons(act),
      worstButtons(act), labelled("Scale", fields.gain), labelled("Shaded", fields.shaded, "shaded"),
      labelled("Shadow edges", fields.edges, "edges"),
      labelled("Slider", fields.split, "split"), labelled("Frame", fields.frame, "frame"), play,
      button("?", "Keys", () => act.help()));
    const update = (view, cell) => {
      for (const name of ["cell", "against", "gain", "split", "frame"]) {
        if (name === "frame") fields.frame.max = cell.frames ? cell.frames.count - 1 : 0;
        fields[name].value = view[name];
      }
      fields.edges.checked = view.edges;
      fields.shaded.checked = view.shaded;
      bar.querySelector("[data-for=shaded]").hidden = !catalogue.shading || view.mode === "frames";
      for (const radio of bar.querySelectorAll("input[type=radio]")) {
        radio.checked = radio.value === view.mode;
        radio.disabled = radio.value === "frames" && !cell.frames;
      }
      for (const name of ["split", "frame"])
        bar.querySelector("[data-for=" + name + "]").hidden = view.mode !== (name === "split" ? "slider" : "frames");
      play.hidden = view.mode !== "frames";
    };
    return { bar, update, play };
  };
})();

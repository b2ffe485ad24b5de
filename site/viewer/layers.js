// Which pictures each view puts into its panes.
(function () {
  "use strict";

  const most = 0.68; // of the window's height, so that the values below stay in sight
  const three = (value) => value.toFixed(3).replace(/^(-?)0\./, "$1.");

  function made(viewer) {
    const { shown, view, catalogue } = viewer;
    const { truth, values, other } = shown;
    const second = other || truth.V;
    const picture = (v) => (shown.shading ? shadowbench.shadedPicture(catalogue, shown.shading, v)
      : shadowbench.visibilityPicture(catalogue, truth.surface, v));
    shown.technique = shown.technique || picture(values);
    shown.second = shown.second || picture(second);
    shown.difference =
      shown.difference || shadowbench.differencePicture(catalogue, truth.surface, values, second, view.gain);
    const names = [viewer.cell(view.cell).variant, other ? viewer.other().variant : "Truth: " + viewer.truth().label];
    return {
      technique: { name: names[0], picture: shown.technique, text: (i) => three(values[i]) },
      second: { name: names[1], picture: shown.second, text: (i) => three(second[i]) },
      difference: {
        name: "Difference", picture: shown.difference, text: (i) => three(values[i] - second[i]), signed: true,
      },
    };
  }

  function frames(viewer) {
    const { shown, view, catalogue } = viewer;
    const { count, moving } = viewer.cell(view.cell).frames;
    const frame = Math.min(view.frame, count - 1);
    const row = frame * catalogue.height;
    const name = frame === 0 ? "scored frame" : "moving frame " + frame + " of " + (count - 1);
    const brightness = view.gain > 1 ? view.gain : 0;
    return [
      [{ name: viewer.cell(view.cell).variant + ", " + name, picture: shown.frames.own, row, moving: frame > 0 }],
      [{ name: "Truth (" + moving + "), " + name, picture: shown.frames.truth, row, moving: frame > 0 }],
      [{ name: "Flicker since the frame before", picture: shown.frames.flicker, row, brightness, moving: true }],
    ];
  }

  // The panes that are used, each a list of one layer, or of two with the slider between them.
  function panesOf(viewer) {
    if (!viewer.shown) return [];
    const { mode } = viewer.view;
    if (mode === "frames") return frames(viewer);
    const { technique, second, difference } = made(viewer);
    if (mode === "slider") return [[technique, second]];
    if (mode === "flicker") return [[viewer.flipped ? second : technique]];
    if (mode === "difference") return [[difference]];
    return [[technique], [second], [difference]];
  }

  function describe(viewer, layers) {
    const names = layers.map((layer) => layer.name).join(" | ");
    return names + " on " + viewer.catalogue.title;
  }

  function legend(viewer) {
    const { view, legend: place } = viewer;
    const { element } = shadowbench;
    const bound = view.gain === 1 ? "1" : "1/" + view.gain;
    const signed = [element("span", { class: "scale signed" }), " leak, +" + bound];
    const parts = view.mode === "frames"
      ? ["no flicker ", element("span", { class: "scale grey" }), " changes by " + bound + " beyond the truth"]
      : [viewer.other() ? "darker than the other, −" + bound + " " : "false shadow, −" + bound + " ", ...signed];
    if (viewer.other() && view.mode !== "frames") parts[2] = " brighter, +" + bound;
    place.replaceChildren(...parts);
  }

  function sizePanes(viewer, used) {
    const { width, height } = viewer.catalogue;
    viewer.panes.forEach((pane, i) => { pane.figure.hidden = i >= used; });
    for (const { canvas } of viewer.panes.slice(0, used)) {
      const full = canvas.parentElement.clientWidth;
      canvas.style.height = Math.round(Math.min((full * height) / width, window.innerHeight * most)) + "px";
    }
  }

  shadowbench.drawView = function (viewer) {
    const panes = panesOf(viewer);
    const { view, shown, catalogue } = viewer;
    viewer.root.dataset.mode = view.mode;
    sizePanes(viewer, panes.length);
    panes.forEach((layers, i) => {
      const { canvas, caption } = viewer.panes[i];
      caption.textContent = layers.map((layer) => layer.name).join(" | ");
      canvas.setAttribute("aria-label", describe(viewer, layers));
      const overlay = { edges: view.edges ? shown.edges : null, pixel: view.pixel, split: view.split };
      shadowbench.drawPane(canvas, viewer.frame(canvas), catalogue, layers, overlay);
    });
    legend(viewer);
  };
})();

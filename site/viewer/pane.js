// A pane: a canvas that shows a part of an image, with what is drawn over it. All panes of a viewer show the same part.
(function () {
  "use strict";

  const mostZoom = 96; // CSS pixels a pixel
  const numbersFrom = 40; // from which on a pixel has room for its value

  // How image positions become positions in a pane of `width` × `height` CSS pixels.
  shadowbench.frameOf = function (view, size, width, height) {
    const fit = Math.min(width / size.width, height / size.height);
    const zoom = view.zoom > fit ? Math.min(view.zoom, mostZoom) : fit;
    const clamped = (centre, length, shown) =>
      length * zoom <= shown ? length / 2 : Math.min(length - shown / zoom / 2, Math.max(shown / zoom / 2, centre));
    const [x, y] = view.centre || (view.pixel ? view.pixel.map((p) => p + 0.5) : [size.width / 2, size.height / 2]);
    const centre = [clamped(x, size.width, width), clamped(y, size.height, height)];
    return { zoom, fit, centre, left: width / 2 - centre[0] * zoom, top: height / 2 - centre[1] * zoom, width, height };
  };

  shadowbench.mostZoom = mostZoom;

  function prepared(canvas) {
    const ratio = window.devicePixelRatio || 1;
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    return context;
  }

  function drawPicture(context, frame, size, layer) {
    context.imageSmoothingEnabled = frame.zoom < 1;
    context.filter = layer.brightness ? "brightness(" + layer.brightness + ")" : "none";
    context.drawImage(layer.picture, 0, layer.row || 0, size.width, size.height, frame.left, frame.top,
      size.width * frame.zoom, size.height * frame.zoom);
    context.filter = "none";
  }

  function drawEdges(context, frame, edges) {
    context.beginPath();
    for (let i = 0; i + 3 < edges.length; i += 4) {
      context.moveTo(frame.left + edges[i] * frame.zoom, frame.top + edges[i + 1] * frame.zoom);
      context.lineTo(frame.left + edges[i + 2] * frame.zoom, frame.top + edges[i + 3] * frame.zoom);
    }
    context.lineWidth = 2.5;
    context.strokeStyle = "rgba(0, 0, 0, 0.55)";
    context.stroke();
    context.lineWidth = 1;
    context.strokeStyle = "#3dffb0";
    context.stroke();
  }

  function shownRange(offset, zoom, shown, length) {
    return [Math.max(0, Math.floor(-offset / zoom)), Math.min(length, Math.ceil((shown - offset) / zoom))];
  }

  function drawNumbers(context, frame, size, text) {
    context.font = Math.min(14, frame.zoom / 3.6) + "px ui-monospace, monospace";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineWidth = 3;
    context.strokeStyle = "#000";
    context.fillStyle = "#fff";
    const [firstRow, endRow] = shownRange(frame.top, frame.zoom, frame.height, size.height);
    const [firstColumn, endColumn] = shownRange(frame.left, frame.zoom, frame.width, size.width);
    for (let y = firstRow; y < endRow; ++y)
      for (let x = firstColumn; x < endColumn; ++x) {
        const at = [frame.left + (x + 0.5) * frame.zoom, frame.top + (y + 0.5) * frame.zoom];
        const value = text(y * size.width + x);
        context.strokeText(value, ...at);
        context.fillText(value, ...at);
      }
  }

  function drawPixel(context, frame, [x, y]) {
    const side = Math.max(frame.zoom, 5);
    const left = frame.left + (x + 0.5) * frame.zoom - side / 2;
    const top = frame.top + (y + 0.5) * frame.zoom - side / 2;
    for (const [grow, colour] of [[2, "#000"], [1, "#fff"]]) {
      context.lineWidth = 1.5;
      context.strokeStyle = colour;
      context.strokeRect(left - grow, top - grow, side + 2 * grow, side + 2 * grow);
    }
  }

  function drawLayer(context, frame, size, layer, overlay) {
    drawPicture(context, frame, size, layer);
    if (overlay.edges && !layer.moving) drawEdges(context, frame, overlay.edges);
    if (layer.text && frame.zoom >= numbersFrom) drawNumbers(context, frame, size, layer.text);
  }

  function drawDivider(context, frame, at) {
    context.fillStyle = "#000";
    context.fillRect(at - 2, 0, 4, frame.height);
    context.fillStyle = "#fff";
    context.fillRect(at - 1, 0, 2, frame.height);
    context.beginPath();
    context.arc(at, frame.height / 2, 9, 0, 7);
    context.fill();
  }

  // Layers are {picture, row, text, brightness, moving}; with two, the first is left of `overlay.split` and the second right.
  shadowbench.drawPane = function (canvas, frame, size, layers, overlay) {
    const context = prepared(canvas);
    const at = layers.length > 1 ? overlay.split * frame.width : frame.width;
    layers.forEach((layer, i) => {
      context.save();
      context.beginPath();
      context.rect(i === 0 ? 0 : at, 0, i === 0 ? at : frame.width - at, frame.height);
      context.clip();
      drawLayer(context, frame, size, layer, overlay);
      context.restore();
    });
    if (layers.length > 1) drawDivider(context, frame, at);
    if (overlay.pixel) drawPixel(context, frame, overlay.pixel);
  };
})();

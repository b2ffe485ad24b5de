// Pointer and wheel over a pane: hover, choosing a pixel, moving the part that is shown, moving the slider.
(function () {
  "use strict";

  const nearDivider = 14; // CSS pixels
  const leastDrag = 4;

  // `viewer` has frame(canvas), size(), view(), hover(pixel), choose(pixel) and change(part of a view).
  shadowbench.followPointer = function (canvas, viewer) {
    let drag = null;

    const place = (event) => {
      const box = canvas.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    const pixelAt = ([x, y]) => {
      const frame = viewer.frame(canvas);
      const size = viewer.size();
      const pixel = [Math.floor((x - frame.left) / frame.zoom), Math.floor((y - frame.top) / frame.zoom)];
      const inside = pixel[0] >= 0 && pixel[1] >= 0 && pixel[0] < size.width && pixel[1] < size.height;
      return inside ? pixel : null;
    };
    const isOnDivider = ([x]) =>
      viewer.view().mode === "slider" && Math.abs(x - viewer.view().split * canvas.clientWidth) < nearDivider;

    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      const at = place(event);
      drag = { from: at, centre: viewer.frame(canvas).centre, divider: isOnDivider(at), moved: false };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      const at = place(event);
      if (!drag) return viewer.hover(pixelAt(at));
      const moved = [at[0] - drag.from[0], at[1] - drag.from[1]];
      drag.moved = drag.moved || Math.hypot(...moved) >= leastDrag;
      if (drag.divider) return viewer.change({ split: Math.min(1, Math.max(0, at[0] / canvas.clientWidth)) });
      const { zoom, fit } = viewer.frame(canvas);
      if (drag.moved && zoom > fit) viewer.change({ centre: drag.centre.map((c, i) => c - moved[i] / zoom) });
    });
    canvas.addEventListener("pointerup", (event) => {
      if (drag && !drag.moved && !drag.divider) viewer.choose(pixelAt(place(event)));
      drag = null;
    });
    canvas.addEventListener("pointercancel", () => { drag = null; });
    canvas.addEventListener("pointerleave", () => viewer.hover(null));
    canvas.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && document.activeElement !== canvas) return; // or nobody could scroll the page
      event.preventDefault();
      viewer.zoomAt(canvas, place(event), event.deltaY < 0 ? 1.25 : 0.8);
    }, { passive: false });
  };
})();

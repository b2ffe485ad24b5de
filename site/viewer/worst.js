// Where an image is most wrong: pixels in falling order of error, none near a worse one, so that each step shows another
// place.
(function () {
  "use strict";

  const apart = 6; // pixels
  const mostPlaces = 200;
  const leastError = 1 / 255;

  // Errors of ±1 are common with hard shadows: among equals, the one with more error around it comes first.
  function errorAround(errors, width, height, i) {
    const x = i % width;
    const y = Math.floor(i / width);
    let sum = 0;
    for (let v = Math.max(0, y - 2); v <= Math.min(height - 1, y + 2); ++v)
      for (let u = Math.max(0, x - 2); u <= Math.min(width - 1, x + 2); ++u) sum += errors[v * width + u];
    return sum;
  }

  function isFarFrom(places, width, i) {
    const x = i % width;
    const y = Math.floor(i / width);
    return places.every((p) => Math.abs((p % width) - x) > apart || Math.abs(Math.floor(p / width) - y) > apart);
  }

  shadowbench.worstPlaces = function (size, surface, values, truth) {
    const errors = values.map((v, i) => (shadowbench.isReceiver(surface[i]) ? Math.abs(v - truth[i]) : 0));
    const wrong = [];
    errors.forEach((error, i) => {
      if (error > leastError) wrong.push([i, error, errorAround(errors, size.width, size.height, i)]);
    });
    wrong.sort((a, b) => b[1] - a[1] || b[2] - a[2] || a[0] - b[0]);
    const places = [];
    for (const [i] of wrong) {
      if (places.length === mostPlaces) break;
      if (isFarFrom(places, size.width, i)) places.push(i);
    }
    return places;
  };
})();

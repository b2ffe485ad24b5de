// Values as colours. Orange and blue are told apart with every kind of colour vision, and both stand out from the dark of
// "no error".
(function () {
  "use strict";

  const surfaces = ["background", "faces away from the light", "receiver", "exactly on a shadow edge"];
  const surfaceColours = [[51, 64, 87], [87, 64, 51], null, [150, 60, 170]];
  const receiver = 2;
  const none = [24, 24, 24];
  const falseShadow = [255, 150, 40];
  const leak = [80, 170, 255];

  shadowbench.surfaceName = (surface) => surfaces[surface] || "unknown";
  shadowbench.isReceiver = (surface) => surface === receiver;

  function mixed(from, to, share) {
    return from.map((c, i) => c + (to[i] - c) * share);
  }

  // sRGB of linear light.
  function encoded(linear) {
    const light = Math.min(1, linear);
    return light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055;
  }

  function grey(value) {
    const level = 255 * Math.min(1, Math.max(0, value));
    return [level, level, level];
  }

  function differenceColour(error, gain) {
    return mixed(none, error < 0 ? falseShadow : leak, Math.min(1, Math.abs(error) * gain));
  }

  // A canvas of the image's size; `colour(i)` is that of receiver pixel i.
  function painted(width, height, surface, colour) {
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext("2d");
    const image = context.createImageData(width, height);
    for (let i = 0; i < width * height; ++i) {
      const [red, green, blue] = surfaceColours[surface[i]] || colour(i);
      image.data.set([red, green, blue, 255], 4 * i);
    }
    context.putImageData(image, 0, 0);
    return canvas;
  }

  shadowbench.visibilityPicture = (size, surface, values) =>
    painted(size.width, size.height, surface, (i) => grey(values[i]));

  // The scene with these shadows: at each pixel red, green and blue of the light that is there without its own, which adds
  // `direct` times as much where visibility is 1 (harness/cells/shading.h has the same).
  shadowbench.shadedPicture = (size, shading, values) =>
    painted(size.width, size.height, [], (i) => {
      const light = 1 + Math.min(1, Math.max(0, values[i])) * shading.direct[i];
      return [shading.red, shading.green, shading.blue].map((ambient) => 255 * encoded(light * ambient[i]));
    });

  // technique − truth on a scale from −1/gain to 1/gain.
  shadowbench.differencePicture = (size, surface, values, truth, gain) =>
    painted(size.width, size.height, surface, (i) => differenceColour(values[i] - truth[i], gain));
})();

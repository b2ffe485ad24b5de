// Pixel values: float images that the pages' data files hand over, and how they are fetched.
// A data file is a classic script, `shadowbench.pixels("simple/pcf", {V: "…"})`, because a browser lets a page from a file
// run scripts beside it and read nothing else. A channel is float32: four planes, lowest byte first, deflated, in base64.
var shadowbench = window.shadowbench || {};

(function () {
  "use strict";

  const packed = new Map(); // name → channels as they came
  const asked = new Map(); // name → promise of unpacked channels
  const waiting = new Map(); // name → resolve, of scripts that are under way

  shadowbench.pixels = function (name, channels) {
    packed.set(name, channels);
    if (waiting.has(name)) waiting.get(name)();
  };

  function bytesOf(base64) {
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
  }

  async function inflated(bytes) {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  function joined(planes) {
    const count = planes.length / 4;
    const bytes = new Uint8Array(planes.length);
    for (let plane = 0; plane < 4; ++plane)
      for (let i = 0; i < count; ++i) bytes[4 * i + plane] = planes[plane * count + i];
    const view = new DataView(bytes.buffer);
    return Float32Array.from({ length: count }, (_, i) => view.getFloat32(4 * i, true));
  }

  async function unpacked(channels) {
    const result = {};
    for (const name of Object.keys(channels)) result[name] = joined(await inflated(bytesOf(channels[name])));
    return result;
  }

  function fetched(name) {
    if (packed.has(name)) return Promise.resolve();
    return new Promise((resolve, reject) => {
      const script = document.createElement("script");
      waiting.set(name, resolve);
      script.onerror = () => reject(new Error("the file of pixel values " + name + ".js is missing"));
      script.src = name.split("/").map(encodeURIComponent).join("/") + ".js";
      document.head.append(script);
    });
  }

  // A promise of the channels of `name`, each a Float32Array, row 0 at the top.
  shadowbench.channels = function (name) {
    if (!asked.has(name)) asked.set(name, fetched(name).then(() => unpacked(packed.get(name))));
    return asked.get(name);
  };
})();

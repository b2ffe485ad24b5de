// What is looked at, and the part of the address behind # that says so: "#pcf&pixel=120,80&zoom=8&mode=slider". What is as at
// first is left out.
(function () {
  "use strict";

  const numbers = (text, count) => {
    const list = text.split(",").map(Number);
    return list.length === count && list.every(Number.isFinite) ? list : null;
  };
  const number = (text, low, high) => {
    const value = text === "" ? NaN : Number(text);
    return Number.isFinite(value) ? Math.min(high, Math.max(low, value)) : null;
  };
  const round = (value) => String(Math.round(1000 * value) / 1000);

  const modes = ["side", "slider", "flicker", "difference", "frames"];

  // name → what it is at first, how it is written and how it is read; reading gives null for what makes no sense.
  const fields = {
    against: { first: "", write: String, read: (text) => text },
    mode: { first: "side", write: String, read: (text) => (modes.includes(text) ? text : null) },
    pixel: { first: null, write: (p) => p.join(","), read: (text) => (/^\d+,\d+$/.test(text) ? numbers(text, 2) : null) },
    centre: { first: null, write: (p) => p.map(round).join(","), read: (text) => numbers(text, 2) },
    zoom: { first: 0, write: round, read: (text) => number(text, 0, 96) },
    split: { first: 0.5, write: round, read: (text) => number(text, 0, 1) },
    gain: { first: 1, write: String, read: (text) => ([1, 4, 16].includes(Number(text)) ? Number(text) : null) },
    shaded: { first: false, write: (on) => (on ? "1" : "0"), read: (text) => text === "1" },
    edges: { first: true, write: (on) => (on ? "1" : "0"), read: (text) => text !== "0" },
    frame: { first: 0, write: String, read: (text) => number(text, 0, 1e6) },
  };

  shadowbench.modes = modes;

  shadowbench.firstView = function (cell) {
    const view = { cell };
    for (const name of Object.keys(fields)) view[name] = fields[name].first;
    return view;
  };

  // Only what an address must not hold as it is becomes a %.
  const encoded = (text) => encodeURIComponent(text).replace(/%(2C|2B|3A|3D)/g, decodeURIComponent);

  shadowbench.addressOf = function (view) {
    let text = "#" + encoded(view.cell);
    for (const name of Object.keys(fields)) {
      const value = view[name];
      if (value === null || value === fields[name].first) continue;
      text += "&" + name + "=" + encoded(fields[name].write(value));
    }
    return text;
  };

  function decoded(text) {
    try {
      return decodeURIComponent(text);
    } catch (error) {
      return text; // a lone % stands for itself
    }
  }

  // The view that an address names; what is missing or makes no sense is as at first.
  shadowbench.viewAt = function (address) {
    const [cell, ...rest] = address.replace(/^#/, "").split("&");
    const view = shadowbench.firstView(decoded(cell));
    for (const part of rest) {
      const at = part.indexOf("=");
      const name = part.slice(0, at);
      if (at < 0 || !Object.hasOwn(fields, name)) continue;
      const value = fields[name].read(decoded(part.slice(at + 1)));
      if (value !== null) view[name] = value;
    }
    return view;
  };
})();

// The values under the pointer, or of the chosen pixel.
(function () {
  "use strict";

  // The shortest decimal that reads back as the same float32.
  shadowbench.exact = function (value) {
    if (!Number.isFinite(value)) return value > 0 ? "∞" : String(value);
    for (let digits = 1; digits < 9; ++digits) {
      const text = Number(value.toPrecision(digits));
      if (Math.fround(text) === value) return String(text);
    }
    return String(Number(value.toPrecision(9)));
  };

  const fields = [
    ["pixel", "Pixel"], ["surface", "Surface"], ["technique", "Technique"], ["truth", "Truth"], ["sigma", "σ of the truth"],
    ["other", "Other technique"], ["error", "Difference"], ["edge", "To the nearest edge"],
  ];

  function verdict(error) {
    if (error === 0) return "";
    return error < 0 ? ", false shadow" : ", leak";
  }

  function valuesAt(shown, [x, y]) {
    const i = y * shown.size.width + x;
    const { truth, values, other } = shown;
    const scored = shadowbench.isReceiver(truth.surface[i]);
    const error = values[i] - (other || truth.V)[i];
    return {
      pixel: x + ", " + y,
      surface: shadowbench.surfaceName(truth.surface[i]) + (scored ? "" : ", not scored"),
      technique: shadowbench.exact(values[i]),
      truth: shadowbench.exact(truth.V[i]),
      sigma: shadowbench.exact(truth.sigma[i]),
      other: other ? shadowbench.exact(other[i]) : "",
      error: scored ? error.toPrecision(4) + (other ? "" : verdict(error)) : "",
      edge: Number.isFinite(truth.edge[i]) ? truth.edge[i].toFixed(3) + " px" : "",
    };
  }

  shadowbench.readout = function () {
    const { element } = shadowbench;
    const outputs = {};
    const rows = fields.map(([name, label]) => {
      outputs[name] = element("dd", { "data-field": name });
      return element("div", {}, element("dt", {}, label), outputs[name]);
    });
    const list = element("dl", { class: "readout" }, ...rows);
    const show = (shown, pixel) => {
      const values = pixel && shown ? valuesAt(shown, pixel) : {};
      for (const [name] of fields) {
        outputs[name].textContent = values[name] || "–";
        outputs[name].parentElement.hidden = (name === "other" && !values.other) || (name === "edge" && !values.edge);
      }
    };
    const text = () => fields.filter(([name]) => outputs[name].textContent !== "–")
      .map(([name, label]) => label + " " + outputs[name].textContent).join("; ");
    return { list, show, text };
  };
})();

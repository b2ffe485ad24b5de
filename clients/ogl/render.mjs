// The command line of OGL's shadows: settings with the library's own defaults, and the bias of its example shadow-maps.html.
import { fileURLToPath } from "node:url";
import puppeteer from "puppeteer-core";
import { run } from "../browser/run.mjs";

await run(puppeteer, fileURLToPath(new URL(".", import.meta.url)), {
    "map-size": { standard: 1024, whole: [16, 8192], help: "width and height of new Shadow(gl, …)" },
    bias: { standard: 0.001, help: "of the lookup, in window depth; of the example" },
    filter: { values: ["linear", "nearest"], standard: "linear",
              help: "of the map's packed depths; the library has linear, and nearest shows what that does" },
});

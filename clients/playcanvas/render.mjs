// The command line of PlayCanvas' shadows: settings with the engine's own defaults.
import { fileURLToPath } from "node:url";
import puppeteer from "puppeteer-core";
import { cards, run } from "../browser/run.mjs";

await run(puppeteer, fileURLToPath(new URL(".", import.meta.url)), {
    type: { values: ["pcf1", "pcf3", "pcf5", "vsm16", "vsm32", "pcss"], standard: "pcf3", help: "light.shadowType" },
    "map-size": { standard: 1024, whole: [16, 8192], help: "light.shadowResolution, of a directional light or VSM" },
    "atlas-size": { standard: 2048, whole: [48, 8192],
                    help: "scene.lighting.shadowAtlasResolution, of a point light: 3 x 3 parts, of which its faces are six" },
    bias: { standard: 0.05, help: "light.shadowBias" },
    "normal-bias": { standard: 0, help: "light.normalOffsetBias" },
    "vsm-bias": { standard: 0.0025, help: "light.vsmBias" },
    cascades: { standard: 1, whole: [1, 4], help: "light.numCascades, of a directional light" },
    distance: { values: ["engine", "scene"], standard: "engine",
                help: "light.shadowDistance of a directional light: the engine's 40, or as far as the scene is" },
    cards,
});

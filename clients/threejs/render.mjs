// The command line of three.js' shadows: settings with the engine's own defaults.
import { fileURLToPath } from "node:url";
import puppeteer from "puppeteer-core";
import { cards, run } from "../browser/run.mjs";

await run(puppeteer, fileURLToPath(new URL(".", import.meta.url)), {
    type: { values: ["basic", "pcf", "pcfsoft", "vsm"], standard: "pcf", help: "renderer.shadowMap.type" },
    "map-size": { standard: 512, whole: [16, 8192], help: "light.shadow.mapSize, of each face for a point light" },
    bias: { standard: 0, help: "light.shadow.bias" },
    "normal-bias": { standard: 0, help: "light.shadow.normalBias" },
    radius: { standard: 1, help: "light.shadow.radius" },
    release: { values: ["current", "r181"], standard: "current", help: "of three.js; r181 is the last with PCFSoftShadowMap" },
    cards,
});

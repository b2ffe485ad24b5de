// The command line of Babylon.js' shadows: settings with the engine's own defaults.
import { fileURLToPath } from "node:url";
import puppeteer from "puppeteer-core";
import { cards, run } from "../browser/run.mjs";

await run(puppeteer, fileURLToPath(new URL(".", import.meta.url)), {
    filter: { values: ["none", "poisson", "pcf", "pcss", "esm", "blur-esm", "close-esm"], standard: "none",
              help: "of the ShadowGenerator" },
    cascades: { standard: 0, whole: [0, 4],
                help: "CascadedShadowGenerator with 2 to 4, for directional lights; 0: a ShadowGenerator" },
    "map-size": { standard: 1024, whole: [16, 8192], help: "of the generator, of each face or cascade" },
    bias: { standard: 0.00005, help: "generator.bias" },
    "normal-bias": { standard: 0, help: "generator.normalBias" },
    floats: { values: ["half", "full"], standard: "half",
              help: "of the map's texels, where it holds no hardware depths (pcf, pcss, cascades do): usefulFloatFirst" },
    "back-faces": { values: ["no", "yes"], standard: "no", help: "generator.forceBackFacesOnly" },
    map: { values: ["auto", "cube", "single"], standard: "auto",
           help: "of a point light; auto: a cube where the filter allows it, else one map around the scene" },
    depths: { values: ["camera", "scene"], standard: "camera",
              help: "of a point light's map: left to the engine, which takes the camera's, or the scene's" },
    cards,
});

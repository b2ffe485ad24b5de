// The command line of Filament's shadows: settings with the engine's own defaults.
import { fileURLToPath } from "node:url";
import puppeteer from "puppeteer-core";
import { run } from "../browser/run.mjs";

await run(puppeteer, fileURLToPath(new URL(".", import.meta.url)), {
    type: { values: ["pcf", "vsm", "dpcf", "pcss"], standard: "pcf", help: "View::setShadowType" },
});

// Whether the engine's default bias is too small without anything of ours: `node clients/babylonjs/alone.mjs` prints how much of
// a ground that casts shadows lies in its own.
import puppeteer from "puppeteer-core";
import { launch } from "../browser/run.mjs";

const browser = await launch(puppeteer);
const page = await browser.newPage();
await page.goto(new URL("alone.html", import.meta.url).href, { waitUntil: "load" });
console.log("side of the ground in metres, filter, casts, bias: share of the ground in its own shadow");
for (const side of [10, 100])
    for (const filter of ["none", "pcf"])
        for (const [casts, bias] of [[false, undefined], [true, undefined], [true, 0.0005], [true, 0.005]]) {
            const { seen, share } = await page.evaluate((chosen) => falselyShadowed(chosen), { side, filter, casts, bias });
            console.log(`${side}, ${filter}, ${casts ? "yes" : "no"}, ${bias ?? "default"}: ${(100 * share).toFixed(2)} % of ${seen} pixels`);
        }
await browser.close();

// Renders an exported scene with a page in headless Chromium: what the clients in browsers share. The page does all drawing
// (its `start` and `renderFrame`); this reads the command line and the folder, and writes the images.
import { access, mkdir, readFile, rename, writeFile } from "node:fs/promises";
import { existsSync } from "node:fs";
import path from "node:path";
import { performance } from "node:perf_hooks";
import { pathToFileURL } from "node:url";
import { parseArgs } from "node:util";

/// An error with a sentence for the user and the exit code of docs/gate.md.
export class Failure extends Error {
    constructor(code, message) {
        super(message);
        this.code = code;
    }
}
const badInput = 2;
const missingTool = 5;

const common = {
    scene: { help: "folder that `shadowbench export` wrote" },
    frames: { help: "numbers of frames, with commas; default: all of the scene" },
    out: { help: "folder for the images, frame-<number>.pfm" },
};

function helpOf(client, settings) {
    const line = ([name, { values, standard, help }]) =>
        `  --${name} ${(values ?? ["…"]).join("|")}  ${help}${standard === undefined ? "" : `; default ${standard}`}`;
    return [
        `usage: clients/${client}/render --scene DIR --out DIR [--frames 59,60] [settings]`,
        "", "Writes the share of the light that arrives at each pixel, 1 = lit, as frame-<number>.pfm.", "",
        ...Object.entries(common).map(line), "", "settings:", ...Object.entries(settings).map(line), "",
        `example: clients/${client}/render --scene exported --frames 59 --out images`,
    ].join("\n");
}

function valueOf(name, { values, standard, whole }, text) {
    if (text === undefined) return standard;
    if (values) {
        if (!values.includes(text)) throw new Failure(badInput, `--${name} ${text}: choose one of ${values.join(", ")}`);
        return text;
    }
    const number = Number(text);
    if (text.trim() === "" || !Number.isFinite(number)) throw new Failure(badInput, `--${name} ${text}: give a number`);
    if (whole && !(Number.isInteger(number) && number >= whole[0] && number <= whole[1]))
        throw new Failure(badInput, `--${name} ${text}: give a whole number from ${whole[0]} to ${whole[1]}`);
    return number;
}

function readCommandLine(settings) {
    const names = [...Object.keys(common), ...Object.keys(settings)];
    const options = Object.fromEntries(names.map((name) => [name, { type: "string" }]));
    options.help = { type: "boolean", short: "h" };
    let values;
    try {
        values = parseArgs({ options }).values;
    } catch (error) {
        throw new Failure(badInput, `${error.message.split("\n")[0]}; --help names the options`);
    }
    if (values.help) return { help: true };
    for (const name of ["scene", "out"])
        if (!values[name]) throw new Failure(badInput, `--${name} is missing; --help shows an example`);
    const chosen = Object.entries(settings).map(([name, setting]) => [name, valueOf(name, setting, values[name])]);
    return { scene: values.scene, frames: values.frames, out: values.out, settings: Object.fromEntries(chosen) };
}

async function readJson(file) {
    try {
        return JSON.parse(await readFile(file, "utf8"));
    } catch (error) {
        throw new Failure(badInput, `cannot read ${file}: ${error.message}; \`shadowbench export\` writes it`);
    }
}

/// With `cards`: where the scene has any, the glTF whose leaves are cards with a mask.
async function readExported(folder, cards) {
    const scene = await readJson(path.join(folder, "scene.json"));
    if (scene.format !== "shadowbench-scene" || scene.version !== 1)
        throw new Failure(badInput, `${folder}/scene.json is not a shadowbench-scene of version 1`);
    const gltf = await readJson(path.join(folder, (cards && scene.cards) || (scene.gltf ?? "scene.gltf")));
    const file = path.join(folder, gltf.buffers[0].uri);
    await access(file).catch(() => { throw new Failure(badInput, `${file} is missing; export the scene again`); });
    const base64 = async (name) => (await readFile(path.join(folder, name))).toString("base64");
    const images = await Promise.all((gltf.images ?? []).map(({ uri }) => base64(uri)));
    return { scene, gltf, images, buffer: await base64(gltf.buffers[0].uri) };
}

function framesToRender(scene, list) {
    if (list === undefined) return scene.frames;
    return list.split(",").map((text) => {
        const frame = scene.frames.find(({ index }) => String(index) === text.trim());
        if (frame) return frame;
        const all = scene.frames.map(({ index }) => index).join(", ");
        throw new Failure(badInput, `--frames: the scene has no frame "${text}"; it has ${all}`);
    });
}

/// A grey PFM: 32-bit floats, little-endian, rows from the bottom, which is how WebGL reads pixels. Whole or not at all.
async function writePfm(file, [width, height], base64) {
    const header = Buffer.from(`Pf\n${width} ${height}\n-1.0\n`, "latin1");
    await writeFile(`${file}.part`, Buffer.concat([header, Buffer.from(base64, "base64")]));
    await rename(`${file}.part`, file);
}

export async function launch(puppeteer) {
    const folders = (process.env.PATH ?? "").split(":");
    const chromium = folders.map((folder) => path.join(folder, "chromium")).find(existsSync);
    if (!chromium) throw new Failure(missingTool, "chromium is missing; as root run: apt-get install chromium");
    return puppeteer.launch({
        executablePath: chromium, headless: true, pipe: true, protocolTimeout: 3600_000,
        args: ["--no-sandbox", // as root there is none; nothing but our own files is loaded
               "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
               "--ignore-gpu-blocklist", "--allow-file-access-from-files", // the page's modules
               "--force-color-profile=srgb", "--hide-scrollbars", "--mute-audio"],
    });
}

async function renderAll(page, exported, frames, { out, settings }) {
    const driver = await page.evaluate((input, chosen) => globalThis.start(input, chosen), exported, settings);
    await mkdir(out, { recursive: true });
    const milliseconds = {};
    for (const frame of frames) {
        const before = performance.now();
        const image = await page.evaluate((index) => globalThis.renderFrame(index), frame.index);
        milliseconds[frame.index] = performance.now() - before;
        await writePfm(path.join(out, `frame-${frame.index}.pfm`), exported.scene.size, image);
    }
    return { driver, milliseconds };
}

async function render(puppeteer, folder, client, settings) {
    const command = readCommandLine(settings);
    if (command.help) return console.log(helpOf(client, settings));
    const exported = await readExported(command.scene, command.settings.cards === "yes");
    const frames = framesToRender(exported.scene, command.frames);
    const browser = await launch(puppeteer);
    try {
        const page = await browser.newPage();
        const problems = [];
        page.on("pageerror", (error) => problems.push(error.message));
        page.on("console", (message) => {
            const isOfUse = ["warn", "error"].includes(message.type()) && !message.text().includes("GL Driver Message");
            if (isOfUse) problems.push(message.text());
        });
        await page.goto(pathToFileURL(path.join(folder, "page.html")).href, { waitUntil: "load" });
        try {
            await page.waitForFunction("globalThis.start !== undefined", { timeout: 60_000 });
            const { driver, milliseconds } = await renderAll(page, exported, frames, command);
            const times = Object.values(milliseconds).map((value) => value.toFixed(0)).join(", ");
            console.log(`${client}: ${frames.length} frames into ${command.out} on ${driver}; ms: ${times}`);
        } catch (error) {
            const refused = /refused: (.*)/.exec(error.message);
            if (refused) throw new Failure(badInput, refused[1]);
            throw new Failure(1, [error.message, ...problems.slice(0, 3)].join("; ").replaceAll("\n", " "));
        }
        for (const problem of new Set(problems)) console.error(`${client}: the page says: ${problem.split("\n")[0]}`);
    } finally {
        await browser.close();
    }
}

/// The setting of clients that test alpha.
export const cards = { values: ["no", "yes"], standard: "no",
                       help: "leaves as cards, of which the engine tests the texture's alpha, in its shadow maps, too" };

/// Renders as the command line says and ends the process with its exit code. `folder` has page.html; `settings` maps an
/// option to its `values`, or none for a number (`whole`: its bounds, if it is whole), its `standard` value and `help`.
export async function run(puppeteer, folder, settings) {
    const client = path.basename(folder);
    try {
        await render(puppeteer, folder, client, settings);
    } catch (error) {
        console.error(`${client}: ${error.message}`);
        process.exit(error instanceof Failure ? error.code : 1);
    }
}

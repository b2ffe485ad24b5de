// Shows what the program sends with each drawing (studies/develop/live_state.cpp), the kept state beside the current one.
"use strict";

const at = (id) => document.getElementById(id);
const made = (name, properties = {}, ...inside) => {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...inside);
  return element;
};

const kinds = [
  ["visibility", "visibility"],
  ["truth", "truth"],
  ["error", "error: red is false shadow, blue is a leak"],
];
let news = null;
let showsKept = false;

const written = (figure, value) => {
  if (value === null) return "–";
  if (figure.share) return `${(100 * value).toPrecision(3)} %`;
  return Number.isInteger(value) ? value.toLocaleString("en") : value.toPrecision(3);
};

const changeOf = (figure) => {
  const { now, kept } = figure;
  if (kept === null) return { text: "new", mark: "" };
  if (now === kept) return { text: "as kept", mark: "" };
  const sign = now > kept ? "+" : "−";
  const size = kept === 0 ? written(figure, Math.abs(now)) : `${(100 * Math.abs(now / kept - 1)).toPrecision(2)} %`;
  return now < kept ? { text: `▼ ${sign}${size}`, mark: "better" } : { text: `▲ ${sign}${size}`, mark: "worse" };
};

const figureLine = (figure) => {
  const { text, mark } = changeOf(figure);
  return made("tr", {}, Object.assign(made("th", { textContent: figure.name }), { scope: "row" }),
    made("td", { textContent: written(figure, figure.now) }), made("td", { textContent: written(figure, figure.kept) }),
    made("td", { textContent: text, className: mark }));
};

const tableOf = (row) => made("table", {},
  made("caption", { textContent: `Figures of ${row.variant} on ${row.scene}` }),
  made("thead", {}, made("tr", {}, ...["figure", "now", "kept", "change"].map((textContent) =>
    Object.assign(made("th", { textContent }), { scope: "col" })))),
  made("tbody", {}, ...row.figures.map(figureLine)));

const pictureOf = (row, number, [kind, caption]) => {
  const which = kind === "truth" ? "" : number === row.last ? "now, " : "kept, ";
  return made("figure", {}, made("img", { src: `/pictures/${number}/${kind}.png`, alt: `${which}${kind} of ${row.variant} on ${row.scene}` }),
    made("figcaption", { textContent: which + caption }));
};

/// The pictures stay while a row or the whole folder is wrong, greyed.
const rowOf = (row) => {
  const number = showsKept ? row.kept : row.last;
  const section = made("section", { className: row.error || news.error ? "old" : "" },
    made("h2", { textContent: `${row.variant} on ${row.scene}` }));
  if (row.error) section.append(made("p", { className: "error", textContent: row.error }));
  if (number !== null) section.append(made("div", { className: "pictures" }, ...kinds.map((kind) => pictureOf(row, number, kind))));
  if (row.figures.length > 0) section.append(tableOf(row));
  return section;
};

const stateOf = () => {
  if (news.drawing) return "drawing …";
  const seconds = `in ${news.seconds.toFixed(1)} s`;
  if (news.error) return `not drawn, ${seconds}`;
  const wrong = news.rows.filter((row) => row.error).length;
  if (wrong > 0) return `${wrong} of ${news.rows.length} rows not drawn, ${seconds}`;
  if (news.rows.length === 0) return "waiting for the first drawing";
  const [error] = news.rows[0].figures;
  return `drawn ${seconds}` + (error ? `; error ${written(error, error.now)}, ${changeOf(error).text}` : "");
};

/// Says a row's error once more where it is read out, as rows are made anew.
const errorOf = () => news.error || (news.rows.find((row) => row.error) || { error: "" }).error;

const show = () => {
  if (!news) return;
  document.title = `${news.folder} – develop`;
  at("folder").textContent = news.folder;
  at("state").textContent = stateOf();
  at("command").textContent = news.command;
  at("flip").setAttribute("aria-pressed", String(showsKept));
  if (news.drawing) return;
  const error = errorOf();
  if (at("error").textContent !== error) at("error").textContent = error;
  at("error").hidden = !error;
  at("warnings").replaceChildren(...news.warnings.map((textContent) => made("p", { className: "warning", textContent })));
  at("rows").replaceChildren(...news.rows.map(rowOf));
};

const keep = () => fetch("/keep", { method: "POST" });
const flip = () => {
  showsKept = !showsKept;
  show();
};
const copy = async () => {
  if (!news) return;
  try {
    await navigator.clipboard.writeText(news.command);
    at("state").textContent = "copied";
  } catch {
    getSelection().selectAllChildren(at("command"));
    at("state").textContent = "the browser does not let a page copy: the command is selected below";
  }
};

const actions = { k: keep, c: flip, y: copy };
for (const [id, action] of [["keep", keep], ["flip", flip], ["copy", copy]]) at(id).addEventListener("click", action);
addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.repeat) return;
  if (Object.hasOwn(actions, event.key)) actions[event.key]();
});

const events = new EventSource("/events");
events.addEventListener("message", (event) => {
  news = JSON.parse(event.data);
  show();
});
events.addEventListener("error", () => {
  at("state").textContent = "the program has ended; start it again";
});

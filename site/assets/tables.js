// Sorts and filters tables, which are there without it.
"use strict";
var shadowbenchTables = (function () {
  const valueOf = (cell) => (cell && cell.hasAttribute("data-v") ? Number.parseFloat(cell.dataset.v) : NaN);
  const atOnce = 40; // rows
  const tables = new Map(); // id → {table, body, rows, heads, listeners}
  const make = (name, attributes, text) => {
    const element = document.createElement(name);
    for (const key in attributes || {}) element.setAttribute(key, attributes[key]);
    if (text !== undefined) element.textContent = text;
    return element;
  };

  // ---- tables ----
  function changed(entry) {
    for (const listener of entry.listeners) listener();
  }

  // Columns keep their widths: a table of thousands of cells then sorts without being measured anew, and does not jump.
  function freeze(entry) {
    if (entry.frozen || entry.rows.length < 30) return;
    entry.frozen = true;
    const widths = entry.heads.map((head) => head.getBoundingClientRect().width);
    entry.heads.forEach((head, i) => { head.style.width = widths[i] + "px"; });
    entry.table.style.width = widths.reduce((sum, width) => sum + width, 0) + "px";
    entry.table.style.tableLayout = "fixed";
  }
  function thaw(entry) {
    if (!entry.frozen) return;
    entry.frozen = false;
    for (const head of entry.heads) head.style.width = "";
    entry.table.style.width = entry.table.style.tableLayout = "";
  }

  function sortBy(entry, column) {
    freeze(entry);
    const head = entry.heads[column];
    const down = head.getAttribute("aria-sort") === "ascending";
    for (const other of entry.heads) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const keys = entry.rows.map((row, place) => {
      const cell = row.cells[column];
      return { row, place, number: valueOf(cell), text: cell.textContent };
    });
    const sign = down ? -1 : 1;
    keys.sort((a, b) => {
      const noneA = Number.isNaN(a.number), noneB = Number.isNaN(b.number);
      if (!noneA && !noneB) return sign * (a.number - b.number) || a.place - b.place;
      if (noneA !== noneB) return noneA ? 1 : -1; // what has no number stays at the end
      return sign * a.text.localeCompare(b.text, "en", { numeric: true }) || a.place - b.place;
    });
    entry.rows = keys.map((key) => key.row);
    // Rows that are moved are laid out anew. What a window shows comes at once, the rest of a long table right after it.
    entry.body.prepend(...entry.rows.slice(0, atOnce));
    clearTimeout(entry.rest);
    if (entry.rows.length > atOnce) entry.rest = setTimeout(() => entry.body.append(...entry.rows.slice(atOnce)));
  }

  const lacksOf = (row) => (row.dataset.lacks || "").split(", ").filter(Boolean);

  function filter(entry, wanted) {
    freeze(entry);
    let count = 0;
    const words = wanted.text.toLowerCase().split(/\s+/).filter(Boolean);
    for (const row of entry.rows) {
      const name = row.cells[0].textContent.toLowerCase();
      const seen = words.every((word) => name.includes(word)) && (!wanted.family || row.dataset.family === wanted.family) &&
        (!wanted.answer || row.dataset.answer === wanted.answer) && (!wanted.within || row.dataset.within === "yes") &&
        !lacksOf(row).some((need) => wanted.needs.includes(need));
      row.hidden = !seen;
      if (seen) ++count;
    }
    changed(entry);
    return count;
  }

  function addFilters(form, entry) {
    const values = (key) => [...new Set(entry.rows.map((row) => row.dataset[key]).filter(Boolean))].sort();
    const text = make("input", { type: "search", placeholder: "part of a name", "aria-label": "Technique" });
    const titles = new Map([...form.parentElement.querySelectorAll(".key .family")].map((e) => [e.dataset.family, e.textContent]));
    const choose = (label, options) => {
      const select = make("select");
      select.append(make("option", { value: "" }, "all"));
      for (const option of options) select.append(make("option", { value: option }, titles.get(option) || option));
      const around = make("label", {}, label);
      around.append(select);
      return [around, select];
    };
    const [familyLabel, family] = choose("family", values("family"));
    const [answerLabel, answer] = choose("answer", values("answer"));
    const within = make("input", { type: "checkbox" });
    const withinLabel = make("label");
    withinLabel.append(within, "within tolerance only");
    const needs = new Map(); // of those that a row lacks: name → checkbox
    for (const need of [...new Set(entry.rows.flatMap(lacksOf))].sort()) needs.set(need, make("input", { type: "checkbox" }));
    const needLabels = [...needs].map(([need, box]) => {
      const label = make("label", { title: "hide techniques without a right answer for this" });
      label.append(box, need.replaceAll("-", " "));
      return label;
    });
    const said = make("output", { "aria-live": "polite" });
    const several = [[familyLabel, "family"], [answerLabel, "answer"]].filter(([, key]) => values(key).length > 1).map(([label]) => label);
    form.append(text, ...several, withinLabel, ...needLabels, said);
    const apply = () => {
      const count = filter(entry, { text: text.value, family: family.value, answer: answer.value, within: within.checked,
        needs: [...needs.keys()].filter((need) => needs.get(need).checked) });
      said.textContent = count + " of " + entry.rows.length;
    };
    form.addEventListener("submit", (event) => event.preventDefault());
    form.addEventListener("input", apply);
    form.hidden = false;
    apply();
  }

  for (const table of document.querySelectorAll("table[data-table]")) {
    const body = table.tBodies[0];
    const entry = { table, body, rows: [...body.rows], heads: [...table.tHead.rows[0].cells], listeners: [] };
    tables.set(table.dataset.table, entry);
    addEventListener("resize", () => thaw(entry));
    entry.heads.forEach((head, column) => {
      const button = make("button", { type: "button", title: head.title }, head.textContent);
      head.replaceChildren(button);
      button.addEventListener("click", () => sortBy(entry, column));
    });
  }
  for (const form of document.querySelectorAll("form[data-filters]")) {
    if (tables.has(form.dataset.filters)) addFilters(form, tables.get(form.dataset.filters));
  }

  // The menu closes when one goes elsewhere.
  for (const menu of document.querySelectorAll("details.menu")) {
    addEventListener("click", (event) => { if (!menu.contains(event.target) || event.target.closest("a")) menu.open = false; });
    addEventListener("keydown", (event) => { if (event.key === "Escape") menu.open = false; });
  }

  return { tables, valueOf, make };
})();

// Draws charts from what tables show, in the place of gnuplot's, which are there without it.
"use strict";
(function () {
  const { tables, valueOf, make } = shadowbenchTables;

  // ---- what charts share ----
  if (typeof d3 === "undefined") return;
  const palette = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8C8C8C"];
  const hint = make("div", { class: "hint", role: "status" });
  hint.hidden = true;
  document.body.append(hint);
  function say(text, event) {
    hint.textContent = text;
    hint.hidden = false;
    const box = hint.getBoundingClientRect();
    hint.style.left = Math.max(4, Math.min(event.clientX + 14, innerWidth - box.width - 8)) + "px";
    hint.style.top = Math.max(4, Math.min(event.clientY + 14, innerHeight - box.height - 8)) + "px";
  }
  const hush = () => { hint.hidden = true; };
  const written = (value, unit) => (unit === "share" ? d3.format(".3~g")(100 * value) + " %" : d3.format(".4~g")(value));
  const shownRows = (entry) => entry.rows.filter((row) => !row.hidden);
  const nameOf = (row) => row.cells[0].textContent;
  // The families of the table's rows, as the table itself names them.
  function familyKey(entry) {
    const key = entry.table.closest("section").querySelector(".key");
    const families = key ? [...key.querySelectorAll(".family")] : [];
    const copy = make("span", { class: "key" });
    copy.append(...families.map((family) => family.cloneNode(true)));
    return copy;
  }
  const familyOf = (row) => row.dataset.family || "";
  const go = (row) => {
    const link = row.querySelector("a[href]");
    if (link) location.href = link.href;
    else point(row);
  };
  function point(row) {
    for (const lit of document.querySelectorAll("tr.lit")) lit.classList.remove("lit");
    row.classList.add("lit");
    const folded = row.closest("details");
    if (folded) folded.open = true;
    row.scrollIntoView({ block: "center" });
  }

  // Logarithmic where all is above 0 and spans a decade; zeros lie on a floor below the rest.
  function scaleOf(values, range, logarithmic) {
    const above = values.filter((value) => value > 0);
    const log = logarithmic !== false && above.length > 0 && values.every((value) => value >= 0) &&
      (logarithmic || d3.max(above) / d3.min(above) > 10);
    if (!log) {
      const [low, high] = d3.extent(values.length ? values : [0, 1]);
      const room = (high - low || Math.abs(high) || 1) * 0.05;
      const linear = d3.scaleLinear().domain([low - room, high + room]).range(range);
      return { at: linear, axis: linear, log: false };
    }
    const low = d3.min(above), zeros = above.length < values.length;
    const floor = low / 3;
    const axis = d3.scaleLog().domain([zeros ? floor / 1.3 : low / 1.25, d3.max(above) * 1.25]).range(range).clamp(true);
    return { at: (value) => axis(value > 0 ? value : floor), axis, log: true, floor: zeros ? floor : 0 };
  }
  function drawAxis(group, scale, side, unit, length) {
    const make = side === "x" ? d3.axisBottom : d3.axisLeft;
    const axis = make(scale.axis).tickSize(-length).tickPadding(7);
    if (scale.log) axis.ticks(5, "~g");
    else axis.ticks(6);
    const short = (value) => (unit === "share" ? d3.format(".3~g")(100 * value) + " %" : d3.format(".4~g")(value));
    if (scale.log) {
      let ticks = scale.axis.ticks(6).filter((value) => /^[125]/.test(value.toExponential()));
      if (ticks.length > 9) ticks = ticks.filter((value) => /^1/.test(value.toExponential()));
      if (scale.floor) ticks = [scale.floor, ...ticks.filter((value) => value > scale.floor * 1.5)];
      axis.tickValues(ticks).tickFormat((value) => (value === scale.floor ? short(0) : short(value)));
    } else axis.tickFormat(short);
    group.attr("class", "grid").call(axis);
  }
  function canvas(figure, height) {
    const old = figure.querySelector("svg.plot");
    if (old) old.remove();
    const image = figure.querySelector("img");
    figure.hidden = false;
    if (image) image.hidden = true;
    const width = Math.max(340, Math.min(1100, figure.clientWidth || 900));
    const svg = d3.create("svg").attr("class", "plot").attr("viewBox", [0, 0, width, height]).attr("role", "group")
      .attr("aria-label", image ? image.alt : figure.querySelector("figcaption").textContent);
    figure.insertBefore(svg.node(), figure.querySelector("figcaption"));
    return { svg, width, height, left: 66, right: 18, top: 16, bottom: 46 };
  }
  function labels(area, x, y) {
    const middle = (area.left + area.width - area.right) / 2, room = 2 * Math.min(middle, area.width - middle);
    const text = area.svg.append("text").attr("x", middle).attr("y", area.height - 8).attr("text-anchor", "middle").text(x);
    if (x.includes(" ") && text.node().getComputedTextLength() > room) { // two lines, broken at the space that is nearest to the middle
      const away = (space) => Math.abs(space.index - x.length / 2);
      const at = [...x.matchAll(/ /g)].sort((a, b) => away(a) - away(b))[0].index;
      text.text("");
      [x.slice(0, at), x.slice(at + 1)].forEach((line, i) => text.append("tspan").attr("x", middle).attr("y", area.height - 16 + 13 * i).text(line));
    }
    area.svg.append("text").attr("transform", "rotate(-90)").attr("x", -(area.top + area.height - area.bottom) / 2).attr("y", 15).attr("text-anchor", "middle").text(y);
  }

  // Names beside points, as the program places them: off every mark, off each other and inside the frame, with a line to one
  // that lies further off; off the boxes of the chart's lines, too, if it can be had. One without a free place is left out.
  function writeNames(area, named, marks, lines) {
    const taken = marks.map(({ x, y }) => ({ left: x - 7, right: x + 7, top: y - 7, bottom: y + 7 })), texts = [];
    const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
    const inside = (box) => box.left >= area.left + 3 && box.right <= area.width - area.right && box.top >= area.top && box.bottom <= area.height - area.bottom - 2;
    const along = (from, to) => d3.range(0.1, 1, 0.05).map((t) => ({ x: from.x + t * (to.x - from.x), y: from.y + t * (to.y - from.y) }))
      .map(({ x, y }) => ({ left: x - 1, right: x + 1, top: y - 1, bottom: y + 1 }));
    const turns = [0, 180, 270, 90, 315, 45, 225, 135, 337.5, 22.5, 202.5, 157.5].map((angle) => (angle * Math.PI) / 180);
    const side = (share) => (share > 0.3 ? 0 : share < -0.3 ? 1 : 0.5);
    for (const point of named) {
      const text = area.svg.append("text").attr("class", "name").text(point.text.slice(0, 48));
      const width = text.node().getComputedTextLength() + 2, height = 14;
      let best = null;
      for (const off of [lines, []]) for (const distance of [10, 18, 28, 40, 55, 75, 100, 130]) for (const turn of turns) {
        const left = point.x + distance * Math.cos(turn) - side(Math.cos(turn)) * width, top = point.y + distance * Math.sin(turn) - side(Math.sin(turn)) * height;
        const box = { left, top, right: left + width, bottom: top + height };
        const to = { x: Math.max(box.left, Math.min(box.right, point.x)), y: Math.max(box.top, Math.min(box.bottom, point.y)) };
        const leader = distance > 10 ? along(point, to) : [];
        if (best || !inside(box) || taken.concat(off).some((other) => meet(box, other)) || leader.some((part) => texts.some((other) => meet(part, other)))) continue;
        best = { box, to, leader };
      }
      if (!best) {
        text.remove();
        continue;
      }
      taken.push(best.box, ...best.leader);
      texts.push(best.box);
      text.attr("x", best.box.left + 1).attr("y", best.box.bottom - 3);
      if (best.leader.length > 0) area.svg.append("line").attr("class", "leader").attr("x1", point.x).attr("y1", point.y).attr("x2", best.to.x).attr("y2", best.to.y);
    }
  }

  // The parts of a line that goes in steps, each right to the next point and then down to it, as boxes.
  const stepsOf = (points) => [].concat(...points.slice(1).map((to, i) => [
    { left: points[i].x, right: to.x, top: points[i].y - 1, bottom: points[i].y + 1 },
    { left: to.x - 1, right: to.x + 1, top: Math.min(points[i].y, to.y), bottom: Math.max(points[i].y, to.y) }]));

  // Calls `draw` once the figure comes near the window, and says how to have it drawn anew: a page of many charts opens at
  // once, and one that was hidden is drawn as wide as it has become.
  function whenSeen(figure, entry, draw) {
    let seen = false;
    const again = () => { if (seen) draw(); };
    const first = () => {
      if (seen) return;
      seen = true;
      draw();
    };
    figure.hidden = false;
    new IntersectionObserver((places, observer) => {
      if (!places.some((place) => place.isIntersecting)) return;
      observer.disconnect();
      first();
    }, { rootMargin: "300px" }).observe(figure);
    addEventListener("beforeprint", first);
    addEventListener("resize", again);
    entry.listeners.push(again);
    return again;
  }

  // One stop of the tab key for all marks of a chart: arrows lead from mark to mark, Enter does what a click does, and the
  // mark that has the focus is described and lit as one under the pointer. `marks`: {node, text, act, light(on or off)}, in
  // their order; `light` may be missing.
  function reachable(marks) {
    const focus = (i) => {
      const next = marks[Math.max(0, Math.min(marks.length - 1, i))];
      for (const mark of marks) mark.node.setAttribute("tabindex", mark === next ? "0" : "-1");
      next.node.focus();
    };
    const steps = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1, Home: -Infinity, End: Infinity };
    marks.forEach((mark, i) => {
      mark.node.setAttribute("tabindex", i === 0 ? "0" : "-1");
      mark.node.setAttribute("role", "link");
      mark.node.setAttribute("aria-label", mark.text.replaceAll("\n", ", "));
      mark.node.addEventListener("focus", () => {
        const box = mark.node.getBoundingClientRect();
        say(mark.text, { clientX: box.right, clientY: box.bottom });
        if (mark.light) mark.light(true);
      });
      mark.node.addEventListener("blur", () => {
        hush();
        if (mark.light) mark.light(false);
      });
      mark.node.addEventListener("keydown", (event) => {
        if (event.key in steps) focus(i + steps[event.key]);
        else if (event.key === "Enter") mark.act();
        else if (event.key === "Escape") hush();
        else return;
        event.preventDefault();
      });
    });
  }

  // ---- accuracy against cost, or any two columns ----
  function scatter(figure, entry) {
    const columns = entry.heads.map((head, column) => ({ column, key: head.dataset.key, unit: head.dataset.unit, title: head.textContent }))
      .filter(({ column }) => entry.rows.some((row) => !Number.isNaN(valueOf(row.cells[column]))));
    if (columns.length < 2) return;
    const bar = make("div", { class: "axes" });
    const select = (label, key) => {
      const element = make("select");
      columns.forEach((column, i) => element.append(make("option", { value: i }, column.title)));
      const found = columns.findIndex((column) => column.key === key);
      element.value = String(Math.max(0, found));
      const around = make("label", {}, label + " ");
      around.append(element);
      bar.append(around);
      return element;
    };
    const across = select("across", figure.dataset.x), up = select("up", figure.dataset.y);
    bar.append(make("span", {}, "● within tolerance, ○ not, □ draws no shadow; line: the Pareto front"));
    bar.append(familyKey(entry));
    figure.prepend(bar);
    // As the program judges it (`dominates`): times count with the interval of their rounds.
    const beats = (a, b) => (a.y <= b.y && a.x * (1 + a.spread) < b.x * (1 - b.spread)) ||
      (a.y < b.y && !(a.x * (1 - a.spread) > b.x * (1 + b.spread)));

    function draw() {
      const x = columns[across.value], y = columns[up.value];
      const all = shownRows(entry).map((row) => ({ row, x: valueOf(row.cells[x.column]), y: valueOf(row.cells[y.column]),
        spread: x.key === "cost" ? Number(row.dataset.spread) || 0 : 0 })).filter((p) => !Number.isNaN(p.y));
      const points = all.filter((p) => !Number.isNaN(p.x));
      // Other renderers have no cost of ours: they stand beside the plot, at their errors, and are on no front.
      const beside = x.key.startsWith("cost") || x.key === "modelled" ? all.filter((p) => Number.isNaN(p.x) && p.row.dataset.family === "external") : [];
      const area = canvas(figure, 460);
      if (beside.length > 0) area.right += 84;
      const limit = y.key === figure.dataset.y && figure.dataset.tolerance ? Number(figure.dataset.tolerance) : NaN;
      const sx = scaleOf(points.map((p) => p.x), [area.left, area.width - area.right]);
      const sy = scaleOf(points.concat(beside).map((p) => p.y).concat(Number.isNaN(limit) ? [] : [limit]), [area.height - area.bottom, area.top]);
      drawAxis(area.svg.append("g").attr("transform", `translate(0,${area.height - area.bottom})`), sx, "x", x.unit, area.height - area.top - area.bottom);
      drawAxis(area.svg.append("g").attr("transform", `translate(${area.left},0)`), sy, "y", y.unit, area.width - area.left - area.right);
      labels(area, figure.dataset[`${x.key}label`] || x.title, y.title);
      const front = points.filter((p) => !points.some((q) => beats(q, p))).sort((a, b) => a.x - b.x || b.y - a.y);
      if (!Number.isNaN(limit)) area.svg.append("line").attr("class", "limit").attr("x1", area.left).attr("x2", area.width - area.right).attr("y1", sy.at(limit)).attr("y2", sy.at(limit));
      area.svg.append("path").attr("class", "front").attr("d", d3.line().x((p) => sx.at(p.x)).y((p) => sy.at(p.y)).curve(d3.curveStepAfter)(front));
      if (beside.length > 0) area.svg.append("text").attr("x", area.width - 50).attr("y", area.height - area.bottom + 17)
        .attr("text-anchor", "middle").text("not measured");
      const places = points.map((p) => sx.at(p.x)).concat(beside.map((p, i) => area.width - 66 + 16 * (i % 3)));
      writeNames(area, front.filter((p) => p.row.dataset.baseline !== "yes").map((p) => ({ x: sx.at(p.x), y: sy.at(p.y), text: nameOf(p.row) })),
        points.concat(beside).map((p, i) => ({ x: places[i], y: sy.at(p.y) })), stepsOf(front.map((p) => ({ x: sx.at(p.x), y: sy.at(p.y) }))));
      const symbol = (p) => d3.symbol().size(75).type(p.row.dataset.baseline === "yes" ? d3.symbolSquare : d3.symbolCircle)();
      const described = (p) => `${nameOf(p.row)}\n${p.row.cells[0].title}\n${x.title} ${Number.isNaN(p.x) ? "not measured here" : written(p.x, x.unit)}, ${y.title} ${written(p.y, y.unit)}`;
      const dots = area.svg.append("g").selectAll("a").data(points.concat(beside)).join("path").attr("class", "dot").attr("d", symbol)
        .attr("transform", (p, i) => `translate(${places[i]},${sy.at(p.y)})`).attr("data-family", (p) => familyOf(p.row))
        .classed("full", (p) => p.row.dataset.within === "yes" && p.row.dataset.baseline !== "yes")
        .on("click", (p) => go(p.row)).on("mousemove", (p) => say(described(p), d3.event)).on("mouseout", hush);
      reachable(dots.data().map((p, i) => ({ node: dots.nodes()[i], at: places[i], text: described(p), act: () => go(p.row) }))
        .sort((a, b) => a.at - b.at));
    }
    const again = whenSeen(figure, entry, draw);
    across.addEventListener("input", again);
    up.addEventListener("input", again);
  }

  // ---- a curve a row over the columns that stand for numbers ----
  function lines(figure, entry) {
    const columns = entry.heads.map((head, column) => ({ column, x: Number.parseFloat(head.dataset.key), title: head.textContent, unit: head.dataset.unit }))
      .filter(({ x }) => !Number.isNaN(x));
    if (columns.length < 2) return;
    const breakColumn = entry.heads.findIndex((head) => head.textContent === "breaks at");
    const limit = figure.dataset.tolerance ? Number(figure.dataset.tolerance) : NaN;
    const key = make("div", { class: "axes" });
    key.append(familyKey(entry));
    figure.prepend(key);
    function draw() {
      const curves = shownRows(entry).map((row) => ({ row, breaks: breakColumn < 0 ? NaN : valueOf(row.cells[breakColumn]),
        points: columns.map((c) => ({ x: c.x, title: c.title, y: valueOf(row.cells[c.column]) })).filter((p) => !Number.isNaN(p.y)) }))
        .filter((curve) => curve.points.length > 0);
      const values = [].concat(...curves.map((curve) => curve.points.map((p) => p.y)));
      const area = canvas(figure, 420);
      if (area.width > 600) area.right = 190;
      const sx = scaleOf(columns.map((c) => c.x), [area.left, area.width - area.right], figure.dataset.xlog === "yes");
      const sy = scaleOf(values.concat(Number.isNaN(limit) ? [] : [limit]), [area.height - area.bottom, area.top]);
      const unit = columns[0].unit;
      drawAxis(area.svg.append("g").attr("transform", `translate(0,${area.height - area.bottom})`), sx, "x", "1", area.height - area.top - area.bottom);
      drawAxis(area.svg.append("g").attr("transform", `translate(${area.left},0)`), sy, "y", unit, area.width - area.left - area.right);
      labels(area, figure.dataset.xlabel || "", figure.dataset.ylabel || "");
      if (!Number.isNaN(limit)) area.svg.append("line").attr("class", "limit").attr("x1", area.left).attr("x2", area.width - area.right).attr("y1", sy.at(limit)).attr("y2", sy.at(limit));
      const line = d3.line().x((p) => sx.at(p.x)).y((p) => sy.at(p.y));
      const groups = area.svg.append("g").selectAll("g").data(curves).join("g");
      const drawn = groups.append("path").attr("class", "curve").attr("data-family", (c) => familyOf(c.row)).attr("d", (c) => line(c.points));
      const described = (c) => nameOf(c.row) + "\n" + [c.points[0], c.points[c.points.length - 1]].map((p) => `${p.title}: ${written(p.y, unit)}`).join(" … ") +
        (Number.isNaN(c.breaks) ? "" : `\nbreaks at ${c.breaks}`);
      reachable(drawn.nodes().map((node, i) => ({ node, text: described(curves[i]), act: () => go(curves[i].row),
        light: (on) => heat(on ? curves[i] : null) })));
      groups.filter((c) => !Number.isNaN(c.breaks)).append("path").attr("d", d3.symbol().type(d3.symbolCross).size(70))
        .attr("transform", (c) => { const p = c.points.find((q) => q.x === c.breaks) || c.points[0]; return `translate(${sx.at(p.x)},${sy.at(p.y)}) rotate(45)`; })
        .attr("class", "break").attr("data-family", (c) => familyOf(c.row));
      let low = Infinity; // names of curves at their ends, where there is room
      const ends = curves.map((c) => ({ c, y: sy.at(c.points[c.points.length - 1].y) })).sort((a, b) => b.y - a.y);
      if (area.width > 600) for (const { c, y } of ends) {
        const at = Math.min(y, low - 12); // above the one before, unless that is far from its curve
        if (y - at > 24 || at < area.top) continue;
        low = at;
        area.svg.append("text").attr("class", "name").attr("x", area.width - area.right + 6).attr("y", at + 4).text(nameOf(c.row).slice(0, 26));
      }
      const heat = (chosen) => groups.select(".curve").classed("dim", (c) => chosen && c !== chosen).classed("hot", (c) => c === chosen);
      groups.selectAll("circle").data((c) => c.points.map((p) => ({ c, p }))).join("circle").attr("r", 5).attr("fill", "transparent")
        .attr("cx", ({ p }) => sx.at(p.x)).attr("cy", ({ p }) => sy.at(p.y))
        .on("mousemove", ({ c, p }) => { heat(c); say(`${nameOf(c.row)}\n${p.title}: ${written(p.y, unit)}` + (Number.isNaN(c.breaks) ? "" : `\nbreaks at ${c.breaks}`), d3.event); })
        .on("mouseout", () => { heat(null); hush(); }).on("click", ({ c }) => go(c.row));
      groups.append("path").attr("d", (c) => line(c.points)).attr("fill", "none").attr("stroke", "transparent").attr("stroke-width", 9)
        .on("mousemove", (c) => { heat(c); say(nameOf(c.row), d3.event); }).on("mouseout", () => { heat(null); hush(); }).on("click", (c) => go(c.row)).lower();
    }
    whenSeen(figure, entry, draw);
  }

  // ---- a bar a row, stacked by column ----
  function bars(figure, entry) {
    const columns = entry.heads.map((head, column) => ({ column, title: head.textContent, key: head.dataset.key })).filter((c) => c.key && c.key !== "total");
    const most = (c) => d3.sum(entry.rows, (row) => valueOf(row.cells[c.column]) || 0);
    const named = columns.slice().sort((a, b) => most(b) - most(a)).slice(0, 6).map((c) => c.title);
    const colour = (title) => (named.includes(title) ? palette[named.indexOf(title)] : "#8C8C8C");
    function draw() {
      const rows = shownRows(entry).map((row) => ({ row, total: valueOf(row.cells[1]) })).sort((a, b) => a.total - b.total);
      const area = canvas(figure, 60 + 17 * rows.length + 30);
      area.left = Math.min(230, area.width * 0.4);
      const totals = rows.map((r) => r.total), median = totals[Math.floor(totals.length / 2)] || 1;
      const longest = Math.min(d3.max(totals) || 1, 4 * median); // a few cost many times what most do
      const sx = d3.scaleLinear().domain([0, longest]).range([area.left, area.width - 64]);
      drawAxis(area.svg.append("g").attr("transform", `translate(0,${area.height - 40})`), { axis: sx }, "x", "1", area.height - 60);
      area.svg.append("text").attr("x", (area.left + area.width) / 2).attr("y", area.height - 6).attr("text-anchor", "middle").text((figure.dataset.unit || "") + " a frame");
      const marks = [];
      rows.forEach(({ row, total }, i) => {
        const y = 24 + 17 * i;
        let from = 0;
        const text = area.svg.append("text").attr("x", area.left - 6).attr("y", y + 10).attr("text-anchor", "end").attr("font-size", 11).text(nameOf(row).slice(0, 34));
        text.attr("class", "reach").on("click", () => point(row));
        marks.push({ node: text.node(), text: `${nameOf(row)}\n${written(total)} ms`, act: () => point(row) });
        for (const c of columns) {
          const value = valueOf(row.cells[c.column]);
          if (!(value > 0)) continue;
          const to = Math.min(from + value, longest);
          if (to > from) area.svg.append("rect").attr("x", sx(from)).attr("y", y).attr("width", sx(to) - sx(from)).attr("height", 13).attr("fill", colour(c.title))
            .on("mousemove", () => say(`${nameOf(row)}\n${c.title}: ${written(value)} ms of ${written(total)} ms`, d3.event)).on("mouseout", hush);
          from += value;
        }
        area.svg.append("text").attr("x", sx(Math.min(total, longest)) + 5).attr("y", y + 10).attr("font-size", 11).text((total > longest ? "› " : "") + written(total));
      });
      reachable(marks);
      let x = 8;
      for (const title of [...named, "other passes"]) {
        area.svg.append("rect").attr("x", x).attr("y", 4).attr("width", 11).attr("height", 11).attr("fill", colour(title));
        area.svg.append("text").attr("x", x + 15).attr("y", 14).attr("font-size", 11).text(title);
        x += 30 + title.length * 6;
      }
    }
    whenSeen(figure, entry, draw);
  }

  const kinds = { scatter, lines, bars };
  for (const figure of document.querySelectorAll("figure[data-chart]")) {
    const entry = tables.get(figure.dataset.table);
    if (entry && kinds[figure.dataset.chart]) kinds[figure.dataset.chart](figure, entry);
  }
})();

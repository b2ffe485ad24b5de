// The viewer of a scene's cells: what is shown, and what each action changes about it.
(function () {
  "use strict";

  const catalogues = new Map();
  const flickerPause = 600; // ms; at most three changes a second are safe to look at (WCAG 2.3.1)
  const framePause = 350;

  // A scene's cells: {scene, title, width, height, shading, truths: [{name, label, data}], cells: [{slug, variant, truth, error,
  // data, frames}]}; `shading`, where there is one, and `data` name pixel files, `frames` holds {count, picture, truth, flicker},
  // pictures of frames one below the other.
  shadowbench.cells = (catalogue) => catalogues.set(catalogue.scene, catalogue);

  const isStill = () => window.matchMedia("(prefers-reduced-motion: reduce)").matches;

  function picture(address) {
    const image = new Image();
    image.src = (shadowbench.files || {})[address] || address; // a site in a single file carries its pictures in itself
    return image.decode().then(() => image);
  }

  // In a site of one file, where every page is a part of it, addresses begin with the page's id: its pages are shown by CSS
  // where an address is an id as it stands, and by `choosePage` where a view follows.
  const pageOf = (root) => root.closest(".page");
  const prefixOf = (root) => (pageOf(root) ? pageOf(root).id + "-cell-" : "");

  // The part of the address that is a viewer's; null where it is about another page.
  function ownAddress(root) {
    const address = location.hash.slice(1);
    const prefix = prefixOf(root);
    if (prefix && address === pageOf(root).id) return "";
    return address.startsWith(prefix) ? "#" + address.slice(prefix.length) : null;
  }

  function choosePage() {
    for (const root of document.querySelectorAll(".page .viewer"))
      pageOf(root).classList.toggle("chosen", ownAddress(root) !== null);
  }

  class Viewer {
    constructor(root, catalogue) {
      this.root = root;
      this.catalogue = catalogue;
      this.view = this.known(shadowbench.viewAt(ownAddress(root) || ""));
      this.hovered = null;
      this.flipped = false;
      this.timer = 0;
      this.build();
      this.load();
    }

    // The view with what this scene does not have as at first.
    known(view) {
      const { cells, truths } = this.catalogue;
      if (!cells.some((cell) => cell.slug === view.cell)) view.cell = cells[0].slug;
      const others = truths.map((t) => t.name).concat(cells.map((c) => "cell:" + c.slug));
      if (!others.includes(view.against)) view.against = this.cell(view.cell).truth;
      if (view.mode === "frames" && !this.cell(view.cell).frames) view.mode = "side";
      if (!this.catalogue.shading) view.shaded = false;
      if (view.pixel && !this.contains(view.pixel)) view.pixel = null;
      return view;
    }

    cell(slug) { return this.catalogue.cells.find((cell) => cell.slug === slug); }
    contains([x, y]) { return x >= 0 && y >= 0 && x < this.catalogue.width && y < this.catalogue.height; }
    other() { return this.view.against.startsWith("cell:") ? this.cell(this.view.against.slice(5)) : null; }
    truth() {
      const name = this.other() ? this.cell(this.view.cell).truth : this.view.against;
      return this.catalogue.truths.find((truth) => truth.name === name) || this.catalogue.truths[0];
    }

    build() {
      const { element } = shadowbench;
      this.act = this.actions();
      this.controls = shadowbench.controls(this.catalogue, this.act);
      this.readout = shadowbench.readout();
      this.help = shadowbench.helpDialog();
      this.status = element("p", { class: "status", role: "status" });
      this.legend = element("p", { class: "legend" });
      this.spoken = element("p", { class: "heard", "aria-live": "polite" });
      this.panes = [0, 1, 2].map(() => this.pane());
      this.root.append(this.controls.bar, element("div", { class: "panes" }, ...this.panes.map((p) => p.figure)),
        this.legend, this.readout.list, this.status, this.spoken, this.help);
      this.root.hidden = false;
      document.addEventListener("keydown", (event) => {
        if (this.isSeen() && !this.help.open && shadowbench.actOnKey(event, this.act)) event.preventDefault();
      });
      window.addEventListener("hashchange", () => this.follow());
      new ResizeObserver(() => this.draw()).observe(this.root);
    }

    pane() {
      const { element } = shadowbench;
      const canvas = element("canvas", { tabindex: 0, role: "img" });
      const caption = element("figcaption", {});
      shadowbench.followPointer(canvas, {
        frame: (c) => this.frame(c), size: () => this.catalogue, view: () => this.view,
        hover: (pixel) => { this.hovered = pixel; this.showValues(); },
        choose: (pixel) => { canvas.focus(); this.choose(pixel); },
        change: (part) => this.change(part),
        zoomAt: (c, at, by) => this.zoomAt(c, at, by),
      });
      return { canvas, caption, figure: element("figure", { class: "pane" }, caption, canvas) };
    }

    frame(canvas) {
      return shadowbench.frameOf(this.view, this.catalogue, canvas.clientWidth, canvas.clientHeight);
    }

    follow() {
      const address = ownAddress(this.root);
      if (address === null) return;
      const view = this.known(shadowbench.viewAt(address));
      if (shadowbench.addressOf(view) === shadowbench.addressOf(this.view)) return;
      this.change(view);
      this.root.scrollIntoView({ block: "nearest" });
    }

    change(part) {
      const before = this.view;
      this.view = this.known({ ...this.view, ...part });
      if (part.cell && !part.against && before.against === this.cell(before.cell).truth)
        this.view.against = this.cell(this.view.cell).truth; // unless another one was chosen, a technique's own truth
      if (before.mode !== this.view.mode) this.restart();
      const loaded = ["cell", "against", "shaded"];
      if (loaded.some((name) => before[name] !== this.view[name]) || !this.shown) return this.load();
      if (before.gain !== this.view.gain) this.shown.difference = null;
      this.draw();
    }

    async load() {
      const token = (this.loading = {});
      const cell = this.cell(this.view.cell);
      const other = this.other();
      this.root.setAttribute("aria-busy", "true");
      try {
        const [own, truth, second] = await Promise.all([cell.data, this.truth().data, (other || cell).data]
          .map((name) => shadowbench.channels(name)));
        const shading = this.view.shaded ? await shadowbench.channels(this.catalogue.shading) : null;
        const frames = cell.frames ? await this.loadFrames(cell.frames) : null;
        if (token !== this.loading) return; // another was chosen meanwhile
        this.shown = { size: this.catalogue, values: own.V, truth, other: other ? second.V : null, frames, shading };
        this.shown.edges = await this.edges();
        this.status.textContent = "";
      } catch (error) {
        if (token !== this.loading) return;
        this.shown = null;
        this.status.textContent = "This cell cannot be shown: " + error.message + ".";
      }
      this.root.removeAttribute("aria-busy");
      this.restart();
      this.draw();
    }

    async loadFrames(frames) {
      const [own, truth, flicker] = await Promise.all([frames.picture, frames.truth, frames.flicker].map(picture));
      return { own, truth, flicker };
    }

    // Those of the truth that has them: the exact ones of the light's centre, if they are known.
    async edges() {
      const exact = this.catalogue.truths.find((truth) => truth.edges) || this.truth();
      return (await shadowbench.channels(exact.data)).edges || [];
    }

    restart() {
      clearInterval(this.timer);
      this.timer = 0;
      this.flipped = false;
      if (this.view.mode === "flicker" && !isStill()) this.timer = setInterval(() => this.alternate(), flickerPause);
    }

    alternate() {
      this.flipped = !this.flipped;
      this.draw();
    }

    choose(pixel) {
      if (!pixel) return;
      this.hovered = null; // a pointer that rests somewhere does not hide what keys choose
      this.change({ pixel });
      this.spoken.textContent = this.readout.text();
    }

    // Chooses a pixel and moves the part that is shown so that it is in sight.
    goTo(pixel) {
      const { zoom, centre, width, height } = this.frame(this.panes[0].canvas);
      const far = pixel.some((p, i) => Math.abs(p + 0.5 - centre[i]) > [width, height][i] / zoom / 2 - 1);
      if (far) this.view.centre = pixel.map((p) => p + 0.5);
      this.choose(pixel);
    }

    zoomAt(canvas, at, by) {
      const frame = this.frame(canvas);
      const zoom = Math.min(shadowbench.mostZoom, frame.zoom * by);
      if (zoom <= frame.fit) return this.change({ zoom: 0, centre: null });
      const point = [(at[0] - frame.left) / frame.zoom, (at[1] - frame.top) / frame.zoom];
      this.change({ zoom, centre: [point[0] + (frame.width / 2 - at[0]) / zoom, point[1] + (frame.height / 2 - at[1]) / zoom] });
    }

    zoom(by) {
      if (by === 0) return this.change({ zoom: 0, centre: null });
      const frame = this.frame(this.panes[0].canvas);
      if (by > 1 && this.view.zoom === 0 && this.view.pixel) this.view.centre = this.view.pixel.map((p) => p + 0.5);
      const zoom = Math.min(shadowbench.mostZoom, frame.zoom * by);
      this.change(zoom <= frame.fit ? { zoom: 0, centre: null } : { zoom });
    }

    worst(step) {
      if (!this.shown) return;
      const { truth, values, other } = this.shown;
      if (!this.shown.worst)
        this.shown.worst = { at: -1, places: shadowbench.worstPlaces(this.catalogue, truth.surface, values, other || truth.V) };
      const { worst } = this.shown;
      if (worst.places.length === 0) {
        this.status.textContent = "No receiver pixel differs by more than 1/255.";
        return;
      }
      const count = worst.places.length;
      worst.at = worst.at < 0 ? (step > 0 ? 0 : count - 1) : (worst.at + step + count) % count;
      const i = worst.places[worst.at];
      if (this.view.zoom === 0) this.view.zoom = Math.max(8, 4 * this.frame(this.panes[0].canvas).fit);
      this.view.centre = null;
      this.goTo([i % this.catalogue.width, Math.floor(i / this.catalogue.width)]);
      this.status.textContent = "Worst place " + (worst.at + 1) + " of " + count + (count === 200 ? " or more" : "") + ".";
    }

    flip() {
      if (this.view.mode === "flicker") {
        clearInterval(this.timer);
        return this.alternate();
      }
      if (this.view.mode !== "frames") return;
      if (this.timer) return this.restart(), this.draw();
      this.timer = setInterval(() => this.step(1), framePause);
      this.draw();
    }

    step(by) {
      const { frames } = this.cell(this.view.cell);
      if (frames) this.change({ frame: (Math.min(this.view.frame, frames.count - 1) + by + frames.count) % frames.count });
    }

    next(list, now, by) { return list[(list.indexOf(now) + by + list.length) % list.length]; }

    actions() {
      return {
        change: (part) => this.change(part),
        mode: (mode) => this.change({ mode }),
        flip: () => this.flip(),
        worst: (step) => this.worst(step),
        zoom: (by) => this.zoom(by),
        technique: (by) => this.change({ cell: this.next(this.catalogue.cells.map((c) => c.slug), this.view.cell, by) }),
        truth: () => this.change({ against: this.next(this.catalogue.truths.map((t) => t.name), this.view.against, 1) }),
        split: (by) => this.change({ split: Math.min(1, Math.max(0, this.view.split + by)) }),
        frame: (by) => this.step(by),
        gain: () => this.change({ gain: this.next([1, 4, 16], this.view.gain, 1) }),
        shaded: () => this.change({ shaded: !this.view.shaded }),
        edges: () => this.change({ edges: !this.view.edges }),
        help: () => this.help.showModal(),
        hasFocus: () => this.panes.some((pane) => pane.canvas === document.activeElement),
        move: (x, y) => {
          const from = this.view.pixel || [Math.floor(this.catalogue.width / 2), Math.floor(this.catalogue.height / 2)];
          const to = [from[0] + x, from[1] + y];
          if (this.contains(to)) this.goTo(to);
        },
      };
    }

    showValues() { this.readout.show(this.shown, this.hovered || this.view.pixel); }

    draw() {
      this.controls.update(this.view, this.cell(this.view.cell));
      this.controls.play.textContent = this.timer && this.view.mode === "frames" ? "Stop" : "Play";
      shadowbench.drawView(this);
      this.showValues();
      this.remember();
    }

    // In a site of one file, the pages that are not looked at are hidden.
    isSeen() { return this.root.offsetParent !== null; }

    remember() {
      clearTimeout(this.remembering);
      if (!this.isSeen()) return;
      this.remembering = setTimeout(() => {
        const address = "#" + prefixOf(this.root) + shadowbench.addressOf(this.view).slice(1);
        if (address !== location.hash) history.replaceState(null, "", address);
        choosePage();
      }, 120);
    }
  }

  // Makes the viewers of pages that are seen, each once.
  function start() {
    choosePage();
    for (const root of document.querySelectorAll(".viewer")) {
      const catalogue = catalogues.get(root.dataset.scene);
      if (root.viewer || !catalogue || catalogue.cells.length === 0) continue;
      if (pageOf(root) && getComputedStyle(pageOf(root)).display === "none") continue;
      root.viewer = new Viewer(root, catalogue);
      if (pageOf(root) && location.hash) root.scrollIntoView({ block: "nearest" }); // not the pictures of that id
    }
  }
  document.addEventListener("DOMContentLoaded", start);
  window.addEventListener("hashchange", start);
  window.addEventListener("load", () => {
    for (const root of document.querySelectorAll(".page .viewer"))
      if (location.hash && root.viewer) root.scrollIntoView({ block: "nearest" });
  });
})();

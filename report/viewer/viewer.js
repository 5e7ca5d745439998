// SPDX-License-Identifier: Apache-2.0
// The live viewer, which renders with the kernel in WebGL 2. While the camera moves, the viewer renders a small picture
// with few steps. When the camera rests, it renders the full picture tile by tile, so that no draw call blocks the
// device for long.
"use strict";
const Viewer = (() => {
    const MOVING_STEPS = 300;                           // per ray
    const MOVING_MS = 40, TILE_MS = 30;                 // time limits of a small picture and of one tile
    const SCALES = [1, 2, 3, 4, 6, 8, 12];              // canvas pixels per pixel of the small picture
    const REST_MS = 500;                                // time without a change until the page's address is updated
    const NARROW = 500;                                 // CSS pixels; a narrower canvas begins with a smaller picture
    const find = (id) => document.getElementById(id);

    let data, canvas, painter, camera, scene, fractal, fast = false;
    let low, full;
    const pressed = new Set();
    let scaleNumber = 3, moving = false, dirty = true, tile = null, speed = 1, last = 0, running = false, tileSide = 32;
    let shown = "", resting = 0;                        // the address of the view that the page's address has; a timer

    function say(text) { find("viewer-says").textContent = text; }
    const view = () => ({ fractal, scene, camera, fast });
    const idle = () => !dirty && tile === null;
    const chosenSize = () => find("viewer-size").value.split("x").map(Number);
    const parameters = () => toParameters(fractal, scene, camera, canvas.width, canvas.height);

    function drawMoving() {
        const begin = performance.now();
        const scale = SCALES[scaleNumber];
        const [w, h] = [Math.max(1, Math.round(canvas.width / scale)), Math.max(1, Math.round(canvas.height / scale))];
        if (!low || low.width !== w || low.height !== h) {
            painter.drop(low);
            low = painter.target(w, h);
        }
        painter.draw(low, view(), MOVING_STEPS);
        painter.pixel(low);
        const took = performance.now() - begin;
        if (took > 1.5 * MOVING_MS && scaleNumber < SCALES.length - 1) ++scaleNumber;
        if (took < 0.4 * MOVING_MS && scaleNumber > 0) --scaleNumber;
        painter.copy(low, full, true);
        painter.copy(low, null, true);
        tile = { x: 0, y: 0, height: tileSide };
    }
    // Renders tiles for about 2 TILE_MS. Returns true if the picture is then complete.
    function drawResting() {
        const begin = performance.now();
        while (tile && performance.now() - begin < 2 * TILE_MS) {
            const one = performance.now();
            const side = tile.height;
            painter.draw(full, view(), data.table.rules.max_steps,
                [tile.x, tile.y, Math.min(4 * side, canvas.width - tile.x), Math.min(side, canvas.height - tile.y)]);
            painter.pixel(full);
            const took = performance.now() - one;
            tile.x += 4 * side;
            if (tile.x >= canvas.width) {
                // Begins the next row of tiles. The tiles' height changes only here.
                tile = tile.y + side >= canvas.height ? null : { x: 0, y: tile.y + side, height: tileSide };
            }
            tileSide = took > TILE_MS ? Math.max(8, tileSide >> 1) : took < TILE_MS / 4 ? Math.min(128, tileSide << 1) : tileSide;
        }
        painter.copy(full, null, false);
        return tile === null;
    }

    const KEYS = { w: [0, 0, 1], s: [0, 0, -1], a: [-1, 0, 0], d: [1, 0, 0], r: [0, 1, 0], f: [0, -1, 0] };
    const TURNS = { arrowleft: [-1, 0, 0], arrowright: [1, 0, 0], arrowup: [0, 1, 0], arrowdown: [0, -1, 0], q: [0, 0, -1], e: [0, 0, 1] };
    function fly(seconds) {
        let way = [0, 0, 0], turn = [0, 0, 0];
        for (const key of pressed) {
            if (KEYS[key]) way = Vec.add(way, KEYS[key]);
            if (TURNS[key]) turn = Vec.add(turn, TURNS[key]);
        }
        if (way.some((v) => v !== 0)) {
            // The camera's speed is proportional to its clearance, as in the film.
            const distance = speed * seconds * Math.max(painter.clearance(view()), 1e-5);
            camera.move(...Vec.scale(distance, way));
        }
        if (turn.some((v) => v !== 0)) camera.turn(...Vec.scale(0.8 * seconds, turn));
        return way.some((v) => v !== 0) || turn.some((v) => v !== 0);
    }

    function step(now) {
        if (!running) return;
        try {
            if (!painter.ready(fractal)) {
                say(`The browser is compiling the kernel for the ${fractal} …`);
            } else {
                const seconds = Math.min(0.1, (now - last) / 1000);
                moving = fly(seconds) || moving;
                if (moving || dirty) {
                    drawMoving();
                    show();
                    dirty = false;
                    moving = false;
                } else if (tile) {
                    say(drawResting() ? "Complete." : `Rendering: ${Math.round(100 * (tile ? tile.y : 0) / canvas.height)} %`);
                }
            }
            find("viewer-picture").disabled = !idle();
            last = now;
            requestAnimationFrame(step);
        } catch (error) {
            running = false;
            say(error.message);
        }
    }
    function change() { dirty = true; }
    function show() {
        say("Moving.");
        const text = find("viewer-dat");
        if (document.activeElement !== text) text.value = parameters();
        clearTimeout(resting);
        resting = setTimeout(keepAddress, REST_MS);
    }

    // Returns the text after # of an address that shows this view.
    function address() {
        const [mode, size] = [fast ? "fast" : "exact", find("viewer-size").value];
        return new URLSearchParams({ fractal, mode, size, dat: parameters().replace(/^#.*\n/gm, "") }).toString();
    }
    // Writes the view to the page's address, unless it is the view with which the page began.
    function keepAddress() {
        if (address() === shown) return;
        shown = address();
        history.replaceState(null, "", `#${shown}`);
    }

    function resize(width, height) {
        canvas.width = width;
        canvas.height = height;
        canvas.style.aspectRatio = `${width} / ${height}`;
        painter.drop(full);
        full = painter.target(width, height);
        change();
    }
    function choose(name) {
        fractal = name;
        scene = structuredClone(data.table.rows[name].official);
        camera = new Camera(scene);
        sliders();
        change();
    }
    // Creates a slider and a display of its value for each parameter; for the colouring, a list of names.
    function sliders() {
        const place = find("viewer-parameters");
        place.replaceChildren();
        const row = data.table.rows[fractal], own = {};
        row.shape.forEach(({ name, slider }, i) => { if (slider) own[`shape.${i}`] = [name, ...slider]; });
        if (row.escape.slider) own.escape = [row.escape.name, ...row.escape.slider];
        const all = { ...own, iterations: ["iterations", 1, 200, 1], detail: ["detail level", -6, -1, 0.1],
            field: ["field of view", 0.2, 2.5, 0.05], colouring: ["colouring"], brightness: ["brightness", 0.2, 3, 0.1] };
        for (const [key, [name, low_, high, by]] of Object.entries(all)) {
            const [field, at] = key.split("."), named = low_ === undefined;
            const [owner, property] = at !== undefined ? [scene[field], at] : [field === "field" ? camera : scene, field];
            const label = document.createElement("label"), value = document.createElement("output");
            const input = document.createElement(named ? "select" : "input");
            const display = (number) => { value.textContent = named ? "" : number; };
            if (named) data.table.rules.colouring_types.forEach((look, type) => input.add(new Option(look, type)));
            else Object.assign(input, { type: "range", min: low_, max: high, step: by });
            input.value = owner[property];
            input.dataset.parameter = key;
            display(Number(owner[property].toPrecision(6)));  // about as many digits as a float has
            input.addEventListener("input", () => {
                owner[property] = Number(input.value);
                display(owner[property]);
                change();
            });
            label.append(name, input, value);
            place.append(label);
        }
    }
    function goTo(text) {
        scene = { ...scene, ...fromParameters(text) };
        camera.look(scene);
        sliders();
        change();
    }

    // Shows a view. wanted: a Map or URLSearchParams with the view's fractal, mode, size and parameter file `dat`.
    // A value that is missing or not among the viewer's choices is ignored.
    function goToView(wanted) {
        for (const name of ["fractal", "mode", "size"]) {
            const select = find(`viewer-${name}`);
            if (![...select.options].some((option) => option.value === wanted.get(name))) continue;
            select.value = wanted.get(name);
            select.dispatchEvent(new Event("change"));
        }
        if (!wanted.has("dat")) return;
        try { goTo(wanted.get("dat")); } catch (error) { say(`The parameter file: ${error.message}`); }
    }
    // Shows the view that the page's address gives, if it gives one: #fractal=NAME&mode=MODE&size=SIZE&dat=TEXT.
    function goToAddress() {
        const wanted = new URLSearchParams(location.hash.slice(1));
        if (!wanted.has("fractal") && !wanted.has("dat")) return;
        goToView(wanted);
        const scroll = () => canvas.scrollIntoView({ block: "center" });
        scroll();
        addEventListener("load", scroll);  // pictures above the viewer may get their height only when they are decoded
    }

    // Saves a file on the user's device.
    function save(name, blob) {
        const link = document.createElement("a");
        link.href = URL.createObjectURL(blob);
        link.download = name;
        link.click();
        URL.revokeObjectURL(link.href);
    }

    function listenToCanvas() {
        canvas.addEventListener("keydown", (event) => {
            const key = event.key.toLowerCase();
            if (event.ctrlKey || event.metaKey || event.altKey || !(KEYS[key] || TURNS[key])) return;
            pressed.add(key);
            event.preventDefault();
        });
        canvas.addEventListener("keyup", (event) => pressed.delete(event.key.toLowerCase()));
        canvas.addEventListener("blur", () => pressed.clear());
        let dragging = null;
        canvas.addEventListener("pointerdown", (event) => {
            canvas.focus({ preventScroll: true });
            canvas.setPointerCapture(event.pointerId);
            dragging = [event.clientX, event.clientY];
        });
        canvas.addEventListener("pointermove", (event) => {
            if (!dragging) return;
            const angle = camera.field * data.table.rules.degrees_per_field * Math.PI / 180 / canvas.clientHeight;
            camera.turn(angle * (event.clientX - dragging[0]), -angle * (event.clientY - dragging[1]), 0);
            dragging = [event.clientX, event.clientY];
            change();
        });
        for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { dragging = null; });
        canvas.addEventListener("wheel", (event) => {
            if (document.activeElement !== canvas) return;
            event.preventDefault();
            speed = Math.min(20, Math.max(0.05, speed * Math.exp(-0.001 * event.deltaY)));
            find("viewer-speed").value = Math.log2(speed);
        }, { passive: false });
        canvas.addEventListener("webglcontextlost", (event) => {
            event.preventDefault();
            running = false;
            say("The browser has reset the graphics device; reload the page.");
        });
    }
    function listenToStage() {
        const stage = find("viewer-stage"), fullScreen = find("viewer-full");
        for (const button of document.querySelectorAll("[data-hold]")) {
            button.addEventListener("pointerdown", () => pressed.add(button.dataset.hold));
            for (const end of ["pointerup", "pointerleave", "pointercancel"]) {
                button.addEventListener(end, () => pressed.delete(button.dataset.hold));
            }
        }
        fullScreen.hidden = !document.fullscreenEnabled;
        fullScreen.addEventListener("click", () => {
            const done = document.fullscreenElement ? document.exitFullscreen() : stage.requestFullscreen();
            done.then(() => canvas.focus({ preventScroll: true }), (error) => say(error.message));
        });
        stage.addEventListener("fullscreenchange", () => {
            resize(...(document.fullscreenElement ? [screen.width, screen.height] : chosenSize()));
        });
    }
    function listenToControls() {
        for (const button of document.querySelectorAll("[data-view]")) {
            button.addEventListener("click", () => goToView(new Map(Object.entries(data.views[button.dataset.view]))));
        }
        find("viewer-fractal").addEventListener("change", (event) => choose(event.target.value));
        find("viewer-mode").addEventListener("change", (event) => { fast = event.target.value === "fast"; change(); });
        find("viewer-size").addEventListener("change", () => resize(...chosenSize()));
        find("viewer-speed").addEventListener("input", (event) => { speed = Math.pow(2, event.target.value); });
        find("viewer-reset").addEventListener("click", () => choose(fractal));
        find("viewer-go").addEventListener("click", () => {
            try { goTo(find("viewer-dat").value); } catch (error) { say(`The parameter file: ${error.message}`); }
        });
        find("viewer-copy").addEventListener("click", () => {
            const text = find("viewer-dat");
            const fallback = () => { text.select(); document.execCommand("copy"); };
            if (navigator.clipboard) navigator.clipboard.writeText(text.value).catch(fallback); else fallback();
            say("Parameter file copied to the clipboard.");
        });
        find("viewer-save").addEventListener("click", () => {
            save("view.dat", new Blob([find("viewer-dat").value], { type: "text/plain" }));
        });
        find("viewer-picture").addEventListener("click", () => picture().toBlob((blob) => save("view.png", blob)));
        addEventListener("hashchange", goToAddress);
    }

    // Returns a canvas with the full picture. The viewer's canvas loses its content once it is on the screen.
    const picture = () => painter.image(full);

    function start() {
        canvas = find("viewer-canvas");
        data = JSON.parse(find("viewer-data").textContent);
        data.table = FRACTAL_TABLE;
        painter = Painter.on(canvas, data);
        if (!painter) {
            find("viewer-none").hidden = false;
            find("viewer-live").hidden = true;
            return;
        }
        listenToCanvas();
        listenToStage();
        listenToControls();
        choose(find("viewer-fractal").value);
        fast = find("viewer-mode").value === "fast";
        if (canvas.clientWidth < NARROW) find("viewer-size").value = "640x360";
        resize(...chosenSize());
        if (data.views.length > 0) goToView(new Map(Object.entries(data.views[0])));
        goToAddress();
        shown = address();
        // Runs the viewer only while the canvas is visible.
        new IntersectionObserver(([entry]) => {
            const was = running;
            running = entry.isIntersecting;
            if (running && !was) requestAnimationFrame((now) => { last = now; step(now); });
        }).observe(canvas);
    }
    if (document.getElementById("viewer-canvas")) start();
    return { idle, picture: () => picture().toDataURL("image/png"), camera: () => camera, dat: parameters };
})();

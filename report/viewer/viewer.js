// The live viewer: draws with the kernel text in WebGL 2. While the camera moves it draws a small picture with few steps;
// when it rests, the whole one tile by tile, so that no draw call keeps the device for long.
"use strict";
const Viewer = (() => {
    const MOVING_STEPS = 300, RESTING_STEPS = 8000;     // samples on a ray
    const MOVING_MS = 40, TILE_MS = 30;                 // what a small picture, and one tile, may take
    const SCALES = [1, 2, 3, 4, 6, 8, 12];              // pixels of the canvas to one of the small picture
    const VERTEX = `#version 300 es
        void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;
    const find = (id) => document.getElementById(id);

    let data, gl, canvas, parallel, camera, scene, fractal = "mandelbulb", fast = false;
    let low, full, probe, sceneBuffer, passBuffer;
    const programs = {};
    const pressed = new Set();
    let scaleNumber = 3, moving = false, dirty = true, tile = null, speed = 1, last = 0, running = false, tileSide = 32;

    function say(text) { find("viewer-says").textContent = text; }

    function target(width, height) {
        const made = { width, height, texture: gl.createTexture(), buffer: gl.createFramebuffer() };
        gl.bindTexture(gl.TEXTURE_2D, made.texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, width, height);
        gl.bindFramebuffer(gl.FRAMEBUFFER, made.buffer);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, made.texture, 0);
        return made;
    }
    function drop(made) {
        if (!made) return;
        gl.deleteTexture(made.texture);
        gl.deleteFramebuffer(made.buffer);
    }

    // Compiling may take a browser seconds: it does so beside us where it can.
    function program(name) {
        if (programs[name]) return programs[name];
        const made = programs[name] = { program: gl.createProgram(), ready: false };
        for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, data.shaders[name]]]) {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, text);
            gl.compileShader(shader);
            gl.attachShader(made.program, shader);
            made.shader = shader;
        }
        gl.linkProgram(made.program);
        return made;
    }
    function ready(name) {
        const made = program(name);
        if (made.ready) return true;
        if (parallel && !gl.getProgramParameter(made.program, parallel.COMPLETION_STATUS_KHR)) return false;
        if (!gl.getProgramParameter(made.program, gl.LINK_STATUS)) {
            const log = gl.getShaderInfoLog(made.shader) || gl.getProgramInfoLog(made.program);
            throw new Error(`the browser cannot compile the kernel text: ${log}`);
        }
        for (const [block, number] of [["SceneBlock", 0], ["PassBlock", 1]]) {
            gl.uniformBlockBinding(made.program, gl.getUniformBlockIndex(made.program, block), number);
        }
        // Where the block has each field: the kernel text may change, and a field that is not known is an error.
        const block = gl.getUniformBlockIndex(made.program, "SceneBlock");
        const fields = [...gl.getActiveUniformBlockParameter(made.program, block, gl.UNIFORM_BLOCK_ACTIVE_UNIFORM_INDICES)];
        const [offsets, strides, types] = [gl.UNIFORM_OFFSET, gl.UNIFORM_ARRAY_STRIDE, gl.UNIFORM_TYPE].map(
            (what) => gl.getActiveUniforms(made.program, fields, what));
        made.layout = fields.map((field, i) => [gl.getActiveUniform(made.program, field).name.split(".").pop().replace("[0]", ""),
            offsets[i], strides[i], types[i] === gl.INT]);
        made.size = gl.getActiveUniformBlockParameter(made.program, block, gl.UNIFORM_BLOCK_DATA_SIZE);
        made.ready = true;
        return true;
    }

    function draw(to, steps, area, probing) {
        const compiled = program(fractal);
        const fields = sceneFields(fractal, data.constants[fractal], scene, camera, to.width, to.height, fast, steps);
        gl.useProgram(compiled.program);
        gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, sceneBuffer);
        gl.bufferData(gl.UNIFORM_BUFFER, packed(fields, compiled.layout, compiled.size), gl.DYNAMIC_DRAW);
        gl.bindBufferBase(gl.UNIFORM_BUFFER, 1, passBuffer);
        gl.bufferData(gl.UNIFORM_BUFFER, new Int32Array([probing ? 1 : 0, 0, 0, 0]), gl.DYNAMIC_DRAW);
        gl.bindFramebuffer(gl.FRAMEBUFFER, to.buffer);
        gl.viewport(0, 0, to.width, to.height);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(...(area || [0, 0, to.width, to.height]));
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        gl.disable(gl.SCISSOR_TEST);
    }
    // Waits for the device by reading a pixel.
    function pixel(of) {
        const bytes = new Uint8Array(4);
        gl.bindFramebuffer(gl.FRAMEBUFFER, of.buffer);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        return bytes;
    }
    function copy(from, to, smooth) {
        gl.bindFramebuffer(gl.READ_FRAMEBUFFER, from.buffer);
        gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, to ? to.buffer : null);
        gl.blitFramebuffer(0, 0, from.width, from.height, 0, 0, canvas.width, canvas.height, gl.COLOR_BUFFER_BIT,
            smooth ? gl.LINEAR : gl.NEAREST);
    }
    // The distance estimate at the eye, from the kernel text.
    function clearance() {
        draw(probe, 1, null, true);
        const d = new DataView(pixel(probe).buffer).getFloat32(0, true);
        return Number.isFinite(d) ? Math.abs(d) : 1;
    }

    function drawMoving() {
        const begin = performance.now();
        const scale = SCALES[scaleNumber];
        const [w, h] = [Math.max(1, Math.round(canvas.width / scale)), Math.max(1, Math.round(canvas.height / scale))];
        if (!low || low.width !== w || low.height !== h) {
            drop(low);
            low = target(w, h);
        }
        draw(low, MOVING_STEPS);
        pixel(low);
        const took = performance.now() - begin;
        if (took > 1.5 * MOVING_MS && scaleNumber < SCALES.length - 1) ++scaleNumber;
        if (took < 0.4 * MOVING_MS && scaleNumber > 0) --scaleNumber;
        copy(low, full, true);
        copy(low, null, true);
        tile = { x: 0, y: 0, height: tileSide };
    }
    // Draws tiles for about a frame's time; true when the picture is whole.
    function drawResting() {
        const begin = performance.now();
        while (tile && performance.now() - begin < 2 * TILE_MS) {
            const one = performance.now();
            const side = tile.height;
            draw(full, RESTING_STEPS, [tile.x, tile.y, Math.min(4 * side, canvas.width - tile.x), Math.min(side, canvas.height - tile.y)]);
            pixel(full);
            const took = performance.now() - one;
            tile.x += 4 * side;
            if (tile.x >= canvas.width) {
                // Another height from the next row on.
                tile = tile.y + side >= canvas.height ? null : { x: 0, y: tile.y + side, height: tileSide };
            }
            tileSide = took > TILE_MS ? Math.max(8, tileSide >> 1) : took < TILE_MS / 4 ? Math.min(128, tileSide << 1) : tileSide;
        }
        copy(full, null, false);
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
            // Speed goes with the room there is, as in the film.
            const distance = speed * seconds * Math.max(clearance(), 1e-5);
            camera.move(...Vec.scale(distance, way));
        }
        if (turn.some((v) => v !== 0)) camera.turn(...Vec.scale(0.8 * seconds, turn));
        return way.some((v) => v !== 0) || turn.some((v) => v !== 0);
    }

    function step(now) {
        if (!running) return;
        try {
            if (!ready(fractal)) {
                say(`The browser is compiling the kernel text for the ${fractal} …`);
            } else {
                const seconds = Math.min(0.1, (now - last) / 1000);
                moving = fly(seconds) || moving;
                if (moving || dirty) {
                    drawMoving();
                    show();
                    dirty = false;
                    moving = false;
                } else if (tile) {
                    say(drawResting() ? "The whole picture." : `Drawing: ${Math.round(100 * (tile ? tile.y : 0) / canvas.height)} %`);
                }
            }
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
        if (document.activeElement !== text) text.value = toParameters(fractal, scene, camera, canvas.width, canvas.height);
    }

    function resize(width, height) {
        canvas.width = width;
        canvas.height = height;
        canvas.style.aspectRatio = `${width} / ${height}`;
        drop(full);
        full = target(width, height);
        change();
    }
    function choose(name) {
        fractal = name;
        scene = structuredClone(data.scenes[name]);
        camera = new Camera(scene);
        sliders();
        change();
    }
    // A slider and its number for each parameter.
    function sliders() {
        const place = find("viewer-parameters");
        place.replaceChildren();
        const all = { ...FRACTALS[fractal].sliders, iterations: ["iterations", 1, 200, 1], detail: ["detail level", -6, -1, 0.1],
            field: ["field of view", 0.2, 2.5, 0.05], colouring: ["colouring type", 0, 4, 1], brightness: ["brightness", 0.2, 3, 0.1] };
        for (const [key, [name, low_, high, by]] of Object.entries(all)) {
            const [field, at] = key.split(".");
            const read = () => (at === undefined ? (field === "field" ? camera.field : scene[field]) : scene[field][at]);
            const label = document.createElement("label"), slider = document.createElement("input"), value = document.createElement("output");
            label.append(name, slider, value);
            Object.assign(slider, { type: "range", min: low_, max: high, step: by, value: read() });
            slider.dataset.parameter = key;
            value.textContent = read();
            slider.addEventListener("input", () => {
                const number = Number(slider.value);
                if (at !== undefined) scene[field][at] = number;
                else if (field === "field") camera.field = number;
                else scene[field] = number;
                value.textContent = number;
                change();
            });
            place.append(label);
        }
    }
    function goTo(text) {
        scene = { ...scene, ...fromParameters(text) };
        camera.look(scene);
        sliders();
        change();
    }

    function listen() {
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
            const angle = camera.field * 65 * Math.PI / 180 / canvas.clientHeight;
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
            say("The browser has taken the graphics device away; reload the page.");
        });
        for (const button of document.querySelectorAll("[data-hold]")) {
            button.addEventListener("pointerdown", () => pressed.add(button.dataset.hold));
            for (const end of ["pointerup", "pointerleave", "pointercancel"]) {
                button.addEventListener(end, () => pressed.delete(button.dataset.hold));
            }
        }
        find("viewer-fractal").addEventListener("change", (event) => choose(event.target.value));
        find("viewer-mode").addEventListener("change", (event) => { fast = event.target.value === "fast"; change(); });
        find("viewer-size").addEventListener("change", (event) => resize(...event.target.value.split("x").map(Number)));
        find("viewer-speed").addEventListener("input", (event) => { speed = Math.pow(2, event.target.value); });
        find("viewer-reset").addEventListener("click", () => choose(fractal));
        find("viewer-go").addEventListener("click", () => {
            try { goTo(find("viewer-dat").value); } catch (error) { say(`The parameter file: ${error.message}`); }
        });
        find("viewer-copy").addEventListener("click", () => {
            const text = find("viewer-dat");
            const fallback = () => { text.select(); document.execCommand("copy"); };
            if (navigator.clipboard) navigator.clipboard.writeText(text.value).catch(fallback); else fallback();
            say("The parameter file is on the clipboard.");
        });
        find("viewer-save").addEventListener("click", () => {
            const link = document.createElement("a");
            link.href = URL.createObjectURL(new Blob([find("viewer-dat").value], { type: "text/plain" }));
            link.download = "view.dat";
            link.click();
            URL.revokeObjectURL(link.href);
        });
    }

    function start() {
        canvas = find("viewer-canvas");
        // The picture is kept so that it can be saved.
        gl = canvas.getContext("webgl2", { antialias: false, depth: false, alpha: false, preserveDrawingBuffer: true });
        if (!gl) {
            find("viewer-none").hidden = false;
            find("viewer-live").hidden = true;
            return;
        }
        data = JSON.parse(find("viewer-data").textContent);
        parallel = gl.getExtension("KHR_parallel_shader_compile");
        sceneBuffer = gl.createBuffer();
        passBuffer = gl.createBuffer();
        probe = target(1, 1);
        listen();
        fractal = find("viewer-fractal").value;
        fast = find("viewer-mode").value === "fast";
        choose(fractal);
        resize(...find("viewer-size").value.split("x").map(Number));
        // It works only while it is seen.
        new IntersectionObserver(([entry]) => {
            const was = running;
            running = entry.isIntersecting;
            if (running && !was) requestAnimationFrame((now) => { last = now; step(now); });
        }).observe(canvas);
    }
    if (document.getElementById("viewer-canvas")) start();
    return { idle: () => !dirty && tile === null, picture: () => canvas.toDataURL("image/png"), camera: () => camera,
        dat: () => toParameters(fractal, scene, camera, canvas.width, canvas.height) };
})();

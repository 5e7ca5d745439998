// SPDX-License-Identifier: Apache-2.0
// WebGL 2 code of the viewer: targets to render to, the kernel's shader programs, and rendering with these programs.
"use strict";
class Painter {
    static VERTEX = `#version 300 es
        void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;

    // Returns a painter, or null if the browser lacks WebGL 2. data.shaders: shaders by fractal; data.table: the first
    // argument of sceneFields() in camera.js.
    static on(canvas, data) {
        const gl = canvas.getContext("webgl2", { antialias: false, depth: false, alpha: false });
        return gl ? new Painter(gl, canvas, data) : null;
    }
    constructor(gl, canvas, data) {
        Object.assign(this, { gl, canvas, data, programs: {} });
        this.parallel = gl.getExtension("KHR_parallel_shader_compile");
        this.sceneBuffer = gl.createBuffer();
        this.passBuffer = gl.createBuffer();
        this.probe = this.target(1, 1);
    }

    target(width, height) {
        const gl = this.gl;
        const made = { width, height, texture: gl.createTexture(), buffer: gl.createFramebuffer() };
        gl.bindTexture(gl.TEXTURE_2D, made.texture);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, width, height);
        gl.bindFramebuffer(gl.FRAMEBUFFER, made.buffer);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, made.texture, 0);
        return made;
    }
    drop(made) {
        if (!made) return;
        this.gl.deleteTexture(made.texture);
        this.gl.deleteFramebuffer(made.buffer);
    }

    // Returns the program of a fractal. The first call begins to compile it, which may take seconds. If the browser
    // can, it compiles in the background.
    program(name) {
        if (this.programs[name]) return this.programs[name];
        const gl = this.gl;
        const made = this.programs[name] = { program: gl.createProgram(), ready: false };
        for (const [kind, text] of [[gl.VERTEX_SHADER, Painter.VERTEX], [gl.FRAGMENT_SHADER, this.data.shaders[name]]]) {
            made.shader = gl.createShader(kind);
            gl.shaderSource(made.shader, text);
            gl.compileShader(made.shader);
            gl.attachShader(made.program, made.shader);
        }
        gl.linkProgram(made.program);
        return made;
    }
    // Returns true if a fractal's program is compiled, false if the browser is still compiling it. Throws an Error if
    // the browser cannot compile it.
    ready(name) {
        const gl = this.gl, made = this.program(name);
        if (made.ready) return true;
        if (this.parallel && !gl.getProgramParameter(made.program, this.parallel.COMPLETION_STATUS_KHR)) return false;
        if (!gl.getProgramParameter(made.program, gl.LINK_STATUS)) {
            const log = gl.getShaderInfoLog(made.shader) || gl.getProgramInfoLog(made.program);
            throw new Error(`the browser cannot compile the kernel: ${log}`);
        }
        const block = gl.getUniformBlockIndex(made.program, "SceneBlock");
        gl.uniformBlockBinding(made.program, block, 0);
        gl.uniformBlockBinding(made.program, gl.getUniformBlockIndex(made.program, "PassBlock"), 1);
        // Queries the layout of the kernel's scene, because fields of the kernel may change. packed() throws an Error
        // if the viewer has no value for a field.
        const fields = [...gl.getActiveUniformBlockParameter(made.program, block, gl.UNIFORM_BLOCK_ACTIVE_UNIFORM_INDICES)];
        const [offsets, strides, types] = [gl.UNIFORM_OFFSET, gl.UNIFORM_ARRAY_STRIDE, gl.UNIFORM_TYPE].map(
            (what) => gl.getActiveUniforms(made.program, fields, what));
        made.layout = fields.map((field, i) => [gl.getActiveUniform(made.program, field).name.split(".").pop().replace("[0]", ""),
            offsets[i], strides[i], types[i] === gl.INT]);
        made.size = gl.getActiveUniformBlockParameter(made.program, block, gl.UNIFORM_BLOCK_DATA_SIZE);
        made.ready = true;
        return true;
    }

    // Renders to the target `to`. view: an object with fractal, scene, camera, fast. steps: the limit per ray. area: x,
    // y, width and height of the part to render; default: all. probing: if true, renders the distance estimate, which
    // viewer.frag describes.
    draw(to, view, steps, area, probing) {
        const gl = this.gl, compiled = this.program(view.fractal);
        const fields = sceneFields(this.data.table, view.fractal, view.scene, view.camera, to.width, to.height, view.fast, steps);
        gl.useProgram(compiled.program);
        gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, this.sceneBuffer);
        gl.bufferData(gl.UNIFORM_BUFFER, packed(fields, compiled.layout, compiled.size), gl.DYNAMIC_DRAW);
        gl.bindBufferBase(gl.UNIFORM_BUFFER, 1, this.passBuffer);
        gl.bufferData(gl.UNIFORM_BUFFER, new Int32Array([probing ? 1 : 0, 0, 0, 0]), gl.DYNAMIC_DRAW);
        gl.bindFramebuffer(gl.FRAMEBUFFER, to.buffer);
        gl.viewport(0, 0, to.width, to.height);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(...(area || [0, 0, to.width, to.height]));
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        gl.disable(gl.SCISSOR_TEST);
    }
    // Returns the bytes of a target's first pixel. To read it, waits until the device has rendered the target.
    pixel(of) {
        const bytes = new Uint8Array(4);
        this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, of.buffer);
        this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, bytes);
        return bytes;
    }
    // Returns a canvas with a target's picture. Its first row is at the top, as browsers expect. WebGL's first row is at
    // the bottom.
    image(of) {
        const gl = this.gl, bytes = new Uint8Array(4 * of.width * of.height), image = new ImageData(of.width, of.height);
        gl.bindFramebuffer(gl.FRAMEBUFFER, of.buffer);
        gl.readPixels(0, 0, of.width, of.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        for (let y = 0; y < of.height; ++y) {
            image.data.set(bytes.subarray(4 * of.width * y, 4 * of.width * (y + 1)), 4 * of.width * (of.height - 1 - y));
        }
        const page = document.createElement("canvas");
        [page.width, page.height] = [of.width, of.height];
        page.getContext("2d").putImageData(image, 0, 0);
        return page;
    }
    // Copies a target, scaled to the canvas's size. to: a target of that size, or null for the canvas itself.
    copy(from, to, smooth) {
        const gl = this.gl;
        gl.bindFramebuffer(gl.READ_FRAMEBUFFER, from.buffer);
        gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, to ? to.buffer : null);
        gl.blitFramebuffer(0, 0, from.width, from.height, 0, 0, this.canvas.width, this.canvas.height, gl.COLOR_BUFFER_BIT,
            smooth ? gl.LINEAR : gl.NEAREST);
    }
    // Returns the kernel's distance estimate at the eye, without its sign; 1 if it is not finite.
    clearance(view) {
        this.draw(this.probe, view, 1, null, true);
        const d = new DataView(this.pixel(this.probe).buffer).getFloat32(0, true);
        return Number.isFinite(d) ? Math.abs(d) : 1;
    }
}

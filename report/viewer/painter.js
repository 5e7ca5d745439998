// SPDX-License-Identifier: Apache-2.0
// WebGL 2 code of the viewer: targets, programs of the kernel, and rendering with them.
"use strict";
class Painter {
    static VERTEX = `#version 300 es
        void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;

    // Returns null without WebGL 2. data: shaders by fractal, and the table (camera.js).
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

    // Compiling may take seconds; it runs in the background if the browser can.
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
    // Returns false while the browser compiles. Throws an Error if that fails.
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
        // Offsets of the block's fields. The kernel may change; an unknown field is an error.
        const fields = [...gl.getActiveUniformBlockParameter(made.program, block, gl.UNIFORM_BLOCK_ACTIVE_UNIFORM_INDICES)];
        const [offsets, strides, types] = [gl.UNIFORM_OFFSET, gl.UNIFORM_ARRAY_STRIDE, gl.UNIFORM_TYPE].map(
            (what) => gl.getActiveUniforms(made.program, fields, what));
        made.layout = fields.map((field, i) => [gl.getActiveUniform(made.program, field).name.split(".").pop().replace("[0]", ""),
            offsets[i], strides[i], types[i] === gl.INT]);
        made.size = gl.getActiveUniformBlockParameter(made.program, block, gl.UNIFORM_BLOCK_DATA_SIZE);
        made.ready = true;
        return true;
    }

    // view: fractal, scene, camera, fast. area: x, y, width and height of the part to render; default: all.
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
    // Waits for the device by reading a pixel.
    pixel(of) {
        const bytes = new Uint8Array(4);
        this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, of.buffer);
        this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, bytes);
        return bytes;
    }
    // Rows start at the top, as in browsers.
    image(of) {
        const gl = this.gl, bytes = new Uint8Array(4 * of.width * of.height), image = new ImageData(of.width, of.height);
        gl.bindFramebuffer(gl.FRAMEBUFFER, of.buffer);
        gl.readPixels(0, 0, of.width, of.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        for (let y = 0; y < of.height; ++y) {
            image.data.set(bytes.subarray(4 * of.width * y, 4 * of.width * (y + 1)), 4 * of.width * (of.height - 1 - y));
        }
        return image;
    }
    // to: a target, or null for the canvas, both of the canvas's size.
    copy(from, to, smooth) {
        const gl = this.gl;
        gl.bindFramebuffer(gl.READ_FRAMEBUFFER, from.buffer);
        gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, to ? to.buffer : null);
        gl.blitFramebuffer(0, 0, from.width, from.height, 0, 0, this.canvas.width, this.canvas.height, gl.COLOR_BUFFER_BIT,
            smooth ? gl.LINEAR : gl.NEAREST);
    }
    // Returns the distance estimate at the eye, from the kernel.
    clearance(view) {
        this.draw(this.probe, view, 1, null, true);
        const d = new DataView(this.pixel(this.probe).buffer).getFloat32(0, true);
        return Number.isFinite(d) ? Math.abs(d) : 1;
    }
}

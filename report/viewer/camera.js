// SPDX-License-Identifier: Apache-2.0
// Camera and scene of the viewer, as core/render/kernel_scene.cpp computes them, and conversion to and from parameter
// files.
"use strict";
const Vec = {
    add: (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]],
    scale: (s, a) => [s * a[0], s * a[1], s * a[2]],
    cross: (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]],
    dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
    unit: (a) => Vec.scale(1 / Math.hypot(...a), a),
    // Returns the vector a, turned about the unit vector n by an angle in radians (Rodrigues' formula).
    turn: (a, n, angle) => Vec.add(Vec.add(Vec.scale(Math.cos(angle), a), Vec.scale(Math.sin(angle), Vec.cross(n, a))),
        Vec.scale((1 - Math.cos(angle)) * Vec.dot(n, a), n)),
};

class Camera {
    constructor(scene) { this.look(scene); }

    // Sets the camera from a parameter file's eye, target and up.
    look(scene) {
        this.eye = scene.eye.slice();
        this.forward = Vec.unit(scene.target.map((t, i) => t - scene.eye[i]));
        this.right = Vec.unit(Vec.cross(this.forward, Vec.unit(scene.up)));
        this.field = scene.field;
    }
    get up() { return Vec.cross(this.right, this.forward); }
    // Turns the camera by angles in radians: yaw to the right, pitch upwards, roll about the view direction.
    turn(yaw, pitch, roll) {
        const up = this.up;
        this.forward = Vec.turn(this.forward, up, -yaw);
        this.right = Vec.turn(this.right, up, -yaw);
        this.forward = Vec.unit(Vec.turn(this.forward, this.right, pitch));
        this.right = Vec.turn(this.right, this.forward, roll);
        this.right = Vec.unit(Vec.add(this.right, Vec.scale(-Vec.dot(this.right, this.forward), this.forward)));
    }
    // Moves the eye by x to the right, y upwards and z forwards.
    move(x, y, z) {
        this.eye = Vec.add(this.eye, Vec.add(Vec.add(Vec.scale(x, this.right), Vec.scale(y, this.up)),
            Vec.scale(z, this.forward)));
    }
}

// Returns the fields of the kernel's Scene by name, with the values that core/render/kernel_scene.cpp sets in float
// (bin/render --print-scene). The first argument is the object that table_script() of report/mandelreport/viewer.py
// makes: `rules` apply to all scenes, `rows` are the fractals by name, with their formulas as functions.
function sceneFields({ rules, rows }, fractal, s, camera, width, height, fast, maxSteps) {
    const row = rows[fractal], inputs = [s.shape, s.escape, s.iterations, rules.largest, 0];
    const step_factor = fast ? Math.min(rules.plain_step_factor, row.step_factor(...inputs)) : rules.plain_step_factor;
    const tangent = Math.tan(camera.field * rules.degrees_per_field / 2 * Math.PI / 180);
    return { width, height, max_iterations: s.iterations, max_steps: maxSteps, fractal_whole: row.whole(...inputs),
        colouring: s.colouring, canonical: fast ? 1 : 0,
        // Float is too imprecise for normals from differences. The picture is the same without the hull. The viewer has
        // no cones and neighbours, which use the other two.
        differences: 0, difference_step: 0, hull: 0, subtile_hull: 0, spacing: 0,
        tolerance: Math.pow(10, Math.fround(s.detail)), step_factor,
        relaxation: fast && step_factor >= rules.plain_step_factor ? rules.longest_relaxed : step_factor, end: rules.end, miss: Infinity,
        brightness: s.brightness, look: rules.looks[s.colouring], root_share: row.root_share, fractal: row.constants(...inputs),
        longitude: 0, longitudes: 0, latitude: 0, latitudes: 0, sun: rules.sun,
        sky_west: [1, 0, 0], sky_up: [0, 1, 0], sky_north: [0, 0, 1], grain: [0, 0, 0],
        eye: camera.eye, forward: camera.forward,
        across: Vec.scale(width / height * tangent, camera.right), upward: Vec.scale(tangent, camera.up) };
}

// Returns the bytes of the shader's uniform block for these fields. `layout`: for each field of the block [name,
// offset, stride if it is an array, true if it is an integer]; offset, stride and `size` in bytes.
function packed(fields, layout, size) {
    const bytes = new ArrayBuffer(size);
    const ints = new Int32Array(bytes), floats = new Float32Array(bytes);
    for (const [name, offset, stride, whole] of layout) {
        if (!(name in fields)) throw new Error(`the viewer has no value for the scene's field ${name}`);
        const to = whole ? ints : floats;
        [fields[name]].flat().forEach((value, i) => { to[(offset + i * (stride || 4)) / 4] = value; });
    }
    return bytes;
}

// Returns a parameter file with which the programs render the same view.
function toParameters(fractal, s, camera, width, height) {
    const line = (numbers) => numbers.map((n) => String(Number(n.toPrecision(12)))).join(" ");
    return [`# bin/render --fractal ${fractal} FILE.dat --precision float`, "# location x, y, z", line(camera.eye), "# look at",
        line(Vec.add(camera.eye, camera.forward)), "# up", line(camera.up), "# field of view", line([camera.field]),
        "# width height", `${width} ${height}`, "# detail level", line([s.detail]), "# the fractal's constants", line(s.shape),
        "# iterations, escape", line([s.iterations, s.escape]), "# colouring", line([s.colouring]), "# brightness",
        line([s.brightness]), "# image file", "view.png", ""].join("\n");
}

// Parses a parameter file. Throws an Error that describes the fault.
function fromParameters(text) {
    const lines = text.split("\n").map((l) => l.trim()).filter((l) => l && !l.startsWith("#"));
    if (lines.length < 10) throw new Error(`${lines.length} entries, expected 11`);
    const wanted = [3, 3, 3, 1, 2, 1, 3, 2, 1, 1];
    const entries = wanted.map((count, i) => {
        const numbers = lines[i].split(/[\s,]+/).slice(0, count).map(Number);
        if (numbers.length !== count || numbers.some(Number.isNaN)) {
            throw new Error(`entry ${i + 1} is '${lines[i]}', expected ${count} number${count > 1 ? "s" : ""}`);
        }
        return numbers;
    });
    return { eye: entries[0], target: entries[1], up: entries[2], field: entries[3][0], size: entries[4], detail: entries[5][0],
        shape: entries[6], iterations: entries[7][0], escape: entries[7][1], colouring: entries[8][0], brightness: entries[9][0] };
}

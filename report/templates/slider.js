// SPDX-License-Identifier: Apache-2.0
// Two pictures with a slider between them, and the map of their differences.
"use strict";
for (const box of document.querySelectorAll(".compare")) {
    const [left, right] = ["left", "right"].map((side) => box.querySelector(`[data-side=${side}]`));
    const [under, over, edge] = [".under", ".over", ".edge"].map((name) => box.querySelector(name));
    const slide = box.querySelector("input"), said = box.querySelector(".said"), canvas = box.querySelector("canvas");
    const picture = (select) => document.getElementById(`pic-${select.value}`);
    const bytes = (image) => {
        const page = document.createElement("canvas");
        [page.width, page.height] = [image.naturalWidth, image.naturalHeight];
        const context = page.getContext("2d", { willReadFrequently: true });
        context.drawImage(image, 0, 0);
        return context.getImageData(0, 0, page.width, page.height);
    };
    const move = () => {
        over.style.clipPath = `inset(0 ${100 - slide.value}% 0 0)`;
        edge.style.left = `${slide.value}%`;
    };
    const compare = async () => {
        const [a, b] = [picture(left), picture(right)];
        [over.src, under.src] = [a.src, b.src];
        await Promise.all([a.decode(), b.decode()]);
        const [first, second] = [bytes(a), bytes(b)];
        const map = new ImageData(first.width, first.height);
        let differing = 0, visible = 0, largest = 0;
        for (let i = 0; i < first.data.length; i += 4) {
            let most = 0;
            for (let c = 0; c < 3; ++c) most = Math.max(most, Math.abs(first.data[i + c] - second.data[i + c]));
            differing += most > 0;
            visible += most > 2;
            largest = Math.max(largest, most);
            map.data.fill(most === 0 ? 255 : 190 * (255 - most) / 255, i, i + 3);
            map.data[i + 3] = 255;
        }
        [canvas.width, canvas.height] = [map.width, map.height];
        canvas.getContext("2d").putImageData(map, 0, 0);
        canvas.hidden = differing === 0;
        const [some, all, seen] = [differing, map.width * map.height, visible].map((count) => count.toLocaleString("en"));
        said.textContent = `${some} of ${all} pixels differ` +
            (differing === 0 ? ": the same bytes." : `, ${seen} by more than 2/255, at most ${largest}/255.`);
    };
    // If the page chooses no pictures, initially shows the effect of float.
    if (!right.querySelector("[selected]")) {
        const float = [...right.options].findLastIndex((option) => option.text.endsWith("float, exact"));
        right.selectedIndex = float >= 0 ? float : right.options.length - 1;
    }
    slide.addEventListener("input", move);
    for (const select of [left, right]) select.addEventListener("change", compare);
    move();
    compare();
}

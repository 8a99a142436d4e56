// SPDX-License-Identifier: Apache-2.0
// The pictures in the page: their 16 bits, and how they are made visible. Everything here is a pure function of a picture
// and of the viewer's settings.
'use strict';
const srisp_pictures = (() => {
    // The bytes of an <img>, four for each pixel.
    async function bytes_of(image) {
        await image.decode();
        const canvas = document.createElement('canvas');
        canvas.width = image.naturalWidth;
        canvas.height = image.naturalHeight;
        const context = canvas.getContext('2d', { willReadFrequently: true });
        context.drawImage(image, 0, 0);
        return context.getImageData(0, 0, canvas.width, canvas.height).data;
    }

    // A figure's picture: { kind, name, width, height, linear }, and `values`, three for each pixel: 0 to 65535 where it is
    // linear, else the photo's own 0 to 255.
    async function load(figure) {
        const width = Number(figure.dataset.width), height = Number(figure.dataset.height), kind = figure.dataset.kind;
        const bytes = await bytes_of(figure.querySelector('img')), linear = kind !== 'photo', count = width * height;
        const values = new Uint16Array(count * 3);
        for (let pixel = 0; pixel < count; ++pixel)
            for (let channel = 0; channel < 3; ++channel) {
                const high = bytes[pixel * 4 + channel];
                values[pixel * 3 + channel] = linear ? high * 256 + bytes[(pixel + count) * 4 + channel] : high;
            }
        return { kind, name: figure.dataset.name, width, height, linear, values };
    }

    // Linear sRGB (or, not balanced, camera RGB) of a pixel, before any clipping.
    function developed(picture, at, development, into) {
        const { values } = picture, { balance, color, balanced, gain } = development, scale = gain / 65535;
        const red = values[at] * scale, green = values[at + 1] * scale, blue = values[at + 2] * scale;
        if (!balanced) {
            into[0] = red;
            into[1] = green;
            into[2] = blue;
            return;
        }
        for (let row = 0; row < 3; ++row)
            into[row] = color[row * 3] * balance[0] * red + color[row * 3 + 1] * balance[1] * green +
                color[row * 3 + 2] * balance[2] * blue;
    }

    function srgb(linear) {
        const value = Math.min(Math.max(linear, 0), 1);
        return 255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * Math.pow(value, 1 / 2.4) - 0.055);
    }

    // Draws columns begin to end of a picture into the pixels of an ImageData of its size.
    function draw(picture, development, pixels, begin, end) {
        const color = [0, 0, 0];
        for (let y = 0; y < picture.height; ++y)
            for (let x = begin; x < end; ++x) {
                const at = y * picture.width + x;
                if (picture.linear)
                    developed(picture, at * 3, development, color);
                for (let channel = 0; channel < 3; ++channel)
                    pixels[at * 4 + channel] = picture.linear ? srgb(color[channel]) : picture.values[at * 3 + channel];
                pixels[at * 4 + 3] = 255;
            }
    }

    // Too dark, right, too bright: told apart by the colour-blind, too.
    const map_colors = [[33, 102, 172], [247, 247, 247], [179, 88, 6]];
    const map_range = 1; // EV

    function map_color(ev, channel) {
        const place = Math.min(Math.max(ev / map_range, -1), 1), end = map_colors[place < 0 ? 0 : 2][channel];
        return map_colors[1][channel] + (end - map_colors[1][channel]) * Math.abs(place);
    }

    function brightness(picture, at, development, color) {
        developed(picture, at, development, color);
        return Math.max(0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2], 0);
    }

    // How much brighter than the truth, in EV; a floor keeps the noise of black from shining.
    function draw_errors(picture, truth, development, pixels) {
        const balanced = { ...development, balanced: true, gain: 1 }, color = [0, 0, 0], floor = 1 / 1024;
        for (let at = 0; at < picture.width * picture.height; ++at) {
            const ratio = (brightness(picture, at * 3, balanced, color) + floor) /
                (brightness(truth, at * 3, balanced, color) + floor);
            for (let channel = 0; channel < 3; ++channel)
                pixels[at * 4 + channel] = map_color(Math.log2(ratio), channel);
            pixels[at * 4 + 3] = 255;
        }
    }

    return { load, draw, draw_errors };
})();

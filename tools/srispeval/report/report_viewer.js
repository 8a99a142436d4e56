// SPDX-License-Identifier: Apache-2.0
// The viewer: one image at a time, large, with its pictures in place of each other.
'use strict';
(() => {
    const part = (name) => document.getElementById('viewer' + name);
    const viewer = part(''), canvas = part('-canvas'), choice = part('-choice'), exposure = part('-exposure');
    const wipe = part('-wipe'), balanced = part('-balanced'), map = part('-map'), keys = part('-keys');
    const context = canvas.getContext('2d', { willReadFrequently: true });
    const articles = Array.from(document.querySelectorAll('article.image')).filter((one) => one.querySelector('figure'));
    let index = 0, current = 0, pictures = [], turn = 0;

    const numbers_of = (text) => text.split(' ').map(Number);
    const ev_text = (value) => (value > 0 ? '+' : value < 0 ? '−' : '') + Math.abs(value).toFixed(1) + ' EV';
    // What a wipe and the error map compare with.
    const truth = () => pictures.find((one) => one.kind === 'truth');
    const other = () => truth() || pictures.find((one) => one.kind === 'photo');
    const can_wipe = () => {
        const there = other(), here = pictures[current];
        return there && there !== here && there.width === here.width && there.height === here.height;
    };
    const is_mapped = () => map.checked && truth() !== undefined && pictures[current].kind === 'result';
    // The column up to which the other picture is drawn.
    const edge = () => can_wipe() ? Math.round(wipe.value / 100 * canvas.width) : 0;

    function development() {
        const { balance, color } = articles[index].dataset;
        return { balance: numbers_of(balance), color: numbers_of(color), balanced: balanced.checked,
                 gain: Math.pow(2, Number(exposure.value)) };
    }

    function fit() {
        const room = canvas.parentElement.getBoundingClientRect();
        const scale = Math.min(room.width / canvas.width, room.height / canvas.height);
        canvas.style.width = Math.floor(canvas.width * scale) + 'px';
        canvas.style.height = Math.floor(canvas.height * scale) + 'px';
    }

    function state_text() {
        const here = pictures[current], texts = [here.name, ev_text(Number(exposure.value))];
        texts.push(balanced.checked ? 'white balance and colour matrix' : 'camera RGB as recorded');
        if (here.kind === 'photo')
            texts.splice(1, 2, 'as it is');
        if (is_mapped())
            texts.splice(1, 2, 'error map');
        else if (map.checked && truth())
            texts.push('the error map is of methods only');
        if (edge() > 0)
            texts.push(other().name + ' in the left ' + wipe.value + ' %');
        return texts.join(', ') + '. Image ' + (index + 1) + ' of ' + articles.length + '.';
    }

    function show() {
        const here = pictures[current];
        if (!here)
            return;
        canvas.width = here.width;
        canvas.height = here.height;
        const image = context.createImageData(here.width, here.height);
        if (is_mapped())
            srisp_pictures.draw_errors(here, truth(), development(), image.data);
        else
            srisp_pictures.draw(here, development(), image.data, 0, here.width);
        if (edge() > 0)
            srisp_pictures.draw(other(), development(), image.data, 0, edge());
        context.putImageData(image, 0, 0);
        fit();
        part('-exposure-text').textContent = ev_text(Number(exposure.value));
        part('-wipe-text').textContent = wipe.value + ' %';
        part('-wipe-name').textContent = other() ? 'Wipe: ' + other().name + ' at the left' : 'Wipe';
        part('-errors').hidden = truth() === undefined;
        part('-map-legend').hidden = !is_mapped();
        canvas.setAttribute('aria-label', here.name + ' of ' + part('-title').textContent);
        part('-state').textContent = state_text();
    }

    function choose(picture) {
        current = (picture + pictures.length) % pictures.length;
        choice.querySelectorAll('input')[current].checked = true;
        show();
    }

    function list_pictures() {
        choice.querySelectorAll('label').forEach((one) => one.remove());
        pictures.forEach((picture, number) => {
            const label = document.createElement('label'), input = document.createElement('input');
            input.type = 'radio';
            input.name = 'picture';
            input.addEventListener('change', () => choose(number));
            label.append(input, ' ' + (number + 1) + ' ' + picture.name);
            choice.append(label);
        });
    }

    // Decodes the pictures of one image; those of the one before are let go.
    async function open(image, name) {
        const mine = ++turn;
        index = (image + articles.length) % articles.length;
        part('-title').textContent = articles[index].querySelector('.title').textContent;
        part('-state').textContent = 'Loading';
        const figures = Array.from(articles[index].querySelectorAll('figure'));
        const loaded = await Promise.allSettled(figures.map(srisp_pictures.load));
        if (mine !== turn)
            return; // the reader went on
        pictures = loaded.filter((one) => one.status === 'fulfilled').map((one) => one.value);
        if (pictures.length === 0) {
            part('-state').textContent = 'The pictures cannot be decoded.';
            return;
        }
        list_pictures();
        // What was shown before; else the first method behind the baseline.
        const results = pictures.filter((one) => one.kind === 'result');
        const first = pictures.find((one) => one.name === name) || results[1] || results[0] || pictures[0];
        choose(pictures.indexOf(first));
    }

    function start(article, name) {
        if (!viewer.open)
            viewer.showModal();
        canvas.focus();
        pictures = [];
        open(articles.indexOf(article), name);
    }

    const turn_to = (step) => open(index + step, pictures[current] ? pictures[current].name : '');
    function toggle(box) {
        box.checked = !box.checked;
        show();
    }
    function slide(range, value) {
        range.value = value;
        show();
    }
    const actions = {
        ArrowLeft: () => choose(current - 1), ArrowRight: () => choose(current + 1),
        ArrowUp: () => turn_to(-1), ArrowDown: () => turn_to(1), p: () => turn_to(-1), n: () => turn_to(1),
        w: () => toggle(balanced), e: () => toggle(map), t: () => slide(wipe, Number(wipe.value) > 0 ? 0 : 50),
        '+': () => slide(exposure, Number(exposure.value) + 0.5), '-': () => slide(exposure, Number(exposure.value) - 0.5),
        '0': () => slide(exposure, 0), '?': () => { keys.open = !keys.open; },
    };

    viewer.addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.altKey || event.metaKey || pictures.length === 0)
            return;
        if (event.target.type === 'range' && event.key.startsWith('Arrow'))
            return;
        const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
        const action = Object.hasOwn(actions, name) ? actions[name] : undefined;
        if (action)
            action();
        else if (name >= '1' && name <= '9' && Number(name) <= pictures.length)
            choose(Number(name) - 1);
        else
            return;
        event.preventDefault();
    });
    for (const control of [exposure, wipe, balanced, map])
        control.addEventListener('input', show);
    part('-close').addEventListener('click', () => viewer.close());
    part('-previous').addEventListener('click', () => turn_to(-1));
    part('-next').addEventListener('click', () => turn_to(1));
    viewer.addEventListener('close', () => { ++turn; pictures = []; });
    new ResizeObserver(fit).observe(canvas.parentElement);

    // The pixel under the pointer; where one presses, the wipe follows.
    canvas.addEventListener('pointermove', (event) => {
        const here = pictures[current];
        if (!here)
            return;
        const x = Math.min(here.width - 1, Math.max(0, Math.floor(event.offsetX / canvas.clientWidth * here.width)));
        const y = Math.min(here.height - 1, Math.max(0, Math.floor(event.offsetY / canvas.clientHeight * here.height)));
        if (event.buttons === 1 && can_wipe())
            slide(wipe, Math.round((x + 1) / here.width * 100));
        const values = Array.from(here.values.subarray((y * here.width + x) * 3, (y * here.width + x) * 3 + 3),
            (value) => here.linear ? (value / 65535).toFixed(4) : String(value));
        part('-pixel').textContent = here.name + ' at ' + x + ', ' + y + ': ' + values.join(' ');
    });

    // Ways in: names in the table of all images, a button beside each title, and the pictures themselves.
    for (const article of articles) {
        const button = document.createElement('button');
        button.type = 'button';
        button.className = 'open';
        button.textContent = 'Open in the viewer';
        button.setAttribute('aria-describedby', 'title-' + article.id);
        button.addEventListener('click', () => start(article));
        article.querySelector('h4').after(button);
        for (const figure of article.querySelectorAll('figure'))
            figure.querySelector('.crop').addEventListener('click', () => start(article, figure.dataset.name));
        for (const link of document.querySelectorAll('.sortable a[href="#' + article.id + '"]'))
            link.addEventListener('click', (event) => {
                event.preventDefault();
                start(article);
            });
    }
    document.documentElement.classList.add('scripted');
})();

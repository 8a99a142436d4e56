// SPDX-License-Identifier: Apache-2.0
// Tables of class "sortable": each head becomes a button that sorts by its column.
'use strict';
(() => {
    const missing = '–';

    function key_of(row, column, is_number) {
        const text = row.cells[column].textContent.trim();
        if (!is_number)
            return text;
        return text === missing || text === '' ? NaN : Number(text.replace('−', '-'));
    }

    // What is missing stays last in both directions.
    function compare(a, b, is_number, sign) {
        if (!is_number)
            return (a === '') - (b === '') || sign * a.localeCompare(b, 'en', { numeric: true });
        return Number.isNaN(a) - Number.isNaN(b) || (Number.isNaN(a) ? 0 : sign * (a - b));
    }

    function sort(table, head) {
        const column = head.cellIndex, is_number = head.classList.contains('n');
        const descending = head.getAttribute('aria-sort') === 'ascending', body = table.tBodies[0];
        const rows = Array.from(body.rows, (row) => ({ row, key: key_of(row, column, is_number) }));
        rows.sort((a, b) => compare(a.key, b.key, is_number, descending ? -1 : 1));
        body.append(...rows.map((one) => one.row));
        for (const other of table.querySelectorAll('th[aria-sort]'))
            other.removeAttribute('aria-sort');
        head.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
    }

    for (const table of document.querySelectorAll('table.sortable'))
        for (const head of table.tHead.rows[table.tHead.rows.length - 1].cells) {
            const button = document.createElement('button');
            button.type = 'button';
            button.append(...head.childNodes);
            head.append(button);
            button.addEventListener('click', () => sort(table, head));
        }
})();

// A table of figures. Where there is no room for its columns, style.css makes a block of each row. The roles are written out, since browsers
// take them from the layout.
import { make } from './figures.mjs'

export class FigureTable {
  /**
   * @param caption what it shows
   * @param head the name of each column; the first is that of the rows
   * @param size `wide` if it takes a whole screen to show its columns, else `small`
   */
  constructor(caption, head, size) {
    this.head = head
    this.body = make('tbody', { role: 'rowgroup' })
    this.element = make('div', { class: `table ${size}` }, make('table', { role: 'table' },
      make('caption', {}, caption),
      make('thead', { role: 'rowgroup' }, make('tr', { role: 'row' }, ...head.map(text => make('th', { scope: 'col', role: 'columnheader' }, text)))),
      this.body))
  }

  /** Adds a row: what is in its name and in each of its cells. */
  add(name, ...cells) {
    this.body.append(make('tr', { role: 'row' }, make('th', { scope: 'row', role: 'rowheader', 'data-name': this.head[0] }, ...name),
      ...cells.map((parts, n) => make('td', { role: 'cell', 'data-name': this.head[n + 1] }, make('span', {}, ...parts)))))
  }

  clear() {
    this.body.replaceChildren()
  }
}

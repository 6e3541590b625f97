// A small line chart as SVG: its colours are those of the page, in both themes, and each line has its own dashes.
import { short } from './figures.mjs'

const Size = { width: 440, height: 210, left: 44, right: 12, top: 24, bottom: 32 }

/**
 * Draws lines.
 * @param title what it shows, for those who do not see it
 * @param lines `{ name, points: [[x, y]] }` each; a y of null breaks the line
 * @param x `{ text, min?, max? }`
 * @param y `{ text, min?, max?, isLog? }`
 */
export function chart(title, lines, x, y) {
  const all = lines.flatMap(line => line.points).filter(point => point[1] !== null && (!y.isLog || point[1] > 0))
  const xs = range(x, all.map(point => point[0])), ys = range(y, all.map(point => point[1]))
  const scale = value => y.isLog ? Math.log10(value) : value
  const px = value => Size.left + (Size.width - Size.left - Size.right) * (value - xs[0]) / (xs[1] - xs[0] || 1)
  const py = value => Size.height - Size.bottom - (Size.height - Size.top - Size.bottom) * (scale(value) - scale(ys[0])) / (scale(ys[1]) - scale(ys[0]) || 1)
  const svg = element('svg', { viewBox: `0 0 ${Size.width} ${Size.height}`, role: 'img', 'aria-label': title, class: 'chart' })
  for (const value of y.isLog ? decades(ys) : ticks(ys)) {
    svg.append(element('line', { x1: Size.left, x2: Size.width - Size.right, y1: py(value), y2: py(value), class: 'grid' }))
    svg.append(label(Math.abs(value) < 1e-3 && value !== 0 ? value.toExponential(0) : short(value), Size.left - 6, py(value) + 4, 'end'))
  }
  for (const value of ticks(xs)) {
    svg.append(label(short(value), px(value), Size.height - Size.bottom + 16, 'middle'))
  }
  svg.append(label(x.text, Size.width - Size.right, Size.height - 3, 'end'), label(y.text, 2, 12, 'start'))
  lines.forEach(({ points }, n) => {
    let path = '', isDown = false
    for (const [at, value] of points) {
      const isDrawn = value !== null && (!y.isLog || value > 0)
      path += isDrawn ? `${isDown ? 'L' : 'M'}${px(at).toFixed(1)} ${py(Math.min(Math.max(value, ys[0]), ys[1])).toFixed(1)}` : ''
      isDown = isDrawn
    }
    svg.append(element('path', { d: path, class: `line of-${n}` }))
  })
  const figure = document.createElement('figure')
  const caption = document.createElement('figcaption')
  lines.length > 1 && lines.forEach(({ name }, n) => {
    const key = element('svg', { viewBox: '0 0 26 8', class: 'chart-key', 'aria-hidden': 'true' })
    key.append(element('path', { d: 'M0 4L26 4', class: `line of-${n}` }))
    const item = document.createElement('span')
    item.append(key, name)
    caption.append(item)
  })
  figure.append(svg, caption)
  return figure
}

function range({ min, max }, values) {
  const least = min ?? Math.min(...values), most = max ?? Math.max(...values)
  return Number.isFinite(least) && Number.isFinite(most) && most > least ? [least, most] : [Number.isFinite(least) ? least : 0, (Number.isFinite(least) ? least : 0) + 1]
}

function ticks([least, most]) {
  const rough = (most - least) / 5, power = 10 ** Math.floor(Math.log10(rough))
  const step = [1, 2, 5, 10].map(times => times * power).find(size => size >= rough)
  return Array.from({ length: 8 }, (_, n) => (Math.ceil(least / step - 1e-9) + n) * step).filter(value => value <= most + step * 1e-9)
}

function decades([least, most]) {
  const from = Math.ceil(Math.log10(least)), to = Math.floor(Math.log10(most)), step = Math.max(1, Math.ceil((to - from) / 4))
  return Array.from({ length: Math.floor((to - from) / step) + 1 }, (_, n) => 10 ** (from + n * step))
}

function label(text, x, y, anchor) {
  const made = element('text', { x, y, 'text-anchor': anchor })
  made.textContent = text
  return made
}

function element(name, attributes) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name)
  for (const [key, value] of Object.entries(attributes)) {
    made.setAttribute(key, value)
  }
  return made
}

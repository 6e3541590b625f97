// The colours of the theme, as style.css has them, for what is drawn on a canvas.

export function readColours() {
  const style = getComputedStyle(document.documentElement)
  const read = name => style.getPropertyValue(`--${name}`).trim()
  return {
    ball: read('ball'), ballEdge: read('ball-edge'), real: read('real'), glow: read('glow'), floor: read('floor'), soft: read('soft'), accent: read('accent'),
    path: read('path'), future: read('future'),
  }
}

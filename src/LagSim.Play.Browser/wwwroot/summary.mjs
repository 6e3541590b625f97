// What the panes show, in words: for those who hear the page, and for a glance.
import { length, set } from './figures.mjs'

const Every = 2000 // milliseconds at least, so that nobody is talked over

/** One sentence for each player, said again only if it changes, and never twice within two seconds. */
export class Summary {
  constructor(element) {
    this.element = element
    this.last = performance.now() - Every / 2 // by then there is something to say
  }

  /** Says how the panes are: `{ name, error, heals, agrees }` each, with `agrees` undefined where nothing is known. */
  tell(panes) {
    const now = performance.now()
    if (now - this.last < Every) {
      return
    }
    const text = panes.map(({ name, error, heals, agrees }) => {
      const off = Number.isNaN(error) ? 'precomputed' : `off by ${length(error)}`
      const state = agrees === undefined ? 'no hash yet' : agrees ? 'agrees' : 'differs'
      return `${name}: ${off}, ${heals} ${heals === 1 ? 'heal' : 'heals'}, ${state}.`
    }).join(' ')
    if (text !== this.element.textContent) {
      this.last = now
      set(this.element, text)
    }
  }
}

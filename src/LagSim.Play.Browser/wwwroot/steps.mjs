// Things to try: five steps, each an ordinary link that holds its set-up. An opened step says what to look at, and does what it needs.
import { make, set } from './figures.mjs'
import { ThesisTest } from './thesis.mjs'

/** The list of steps, and the one that is open. */
export class Steps {
  /**
   * @param section where it is built
   * @param steps what the engine offers
   * @param on what is called: `open(name, query)` for the set-up of a step, `close()`, `restore(name)`, `act(name, deed)`, and
   *   `seed(text)`, whether it can be
   */
  constructor(section, steps, on) {
    this.section = section
    this.steps = steps
    this.on = on
    this.panel = make('div', { class: 'step', id: 'step', hidden: '' })
    const list = make('ol', {}, ...steps.map((step, n) => make('li', {}, make('a', { href: address(step.name, step.query), 'data-step': step.name },
      make('b', { 'aria-hidden': 'true' }, String(n + 1)), make('span', {}, step.title, make('small', {}, step.subtitle))))))
    section.append(make('h2', { id: 'steps-title' }, 'Things to try'), list, this.panel)
    section.addEventListener('click', event => this.follow(event))
    section.hidden = false
  }

  /** Whether there is a step of that name. */
  has(name) { return this.steps.some(step => step.name === name) }

  /** The set-up of a step; that of none is the usual one. */
  queryOf(name) { return this.steps.find(step => step.name === name)?.query ?? '' }

  get names() { return this.steps.map(step => step.name) }

  /** A link of a step is followed in the page itself, unless a person wants it elsewhere. */
  follow(event) {
    const link = event.target.closest('a[data-step]')
    if (link && event.button === 0 && !event.ctrlKey && !event.metaKey && !event.shiftKey && !event.altKey) {
      event.preventDefault()
      this.on.open(link.dataset.step, new URLSearchParams(new URL(link.href).search))
    }
  }

  /** Shows a step; none for null. */
  show(name, seed) {
    this.test?.stop()
    this.test = null
    const step = this.steps.find(one => one.name === name)
    for (const link of this.section.querySelectorAll('ol a')) {
      link.dataset.step === name ? link.setAttribute('aria-current', 'step') : link.removeAttribute('aria-current')
    }
    const list = this.section.querySelector('ol'), open = list.querySelector('[aria-current]')
    open && list.scrollTo({ left: open.offsetLeft - list.offsetLeft - 8 }) // on a phone not all are seen at once
    this.panel.hidden = !step
    this.panel.replaceChildren()
    if (!step) {
      return
    }
    const close = make('button', { type: 'button', class: 'close', 'aria-label': 'Close this step' }, '×')
    close.addEventListener('click', () => this.on.close())
    this.open = step
    this.says = make('span')
    const restore = make('button', { type: 'button' }, 'Set the worlds up as the step says')
    restore.addEventListener('click', () => {
      this.on.restore(step.name)
      close.focus() // this button is gone
    })
    this.changed = make('div', { class: 'changed', role: 'status', hidden: '' }, this.says, restore)
    const buttons = step.deeds.map((text, number) => {
      const button = make('button', { type: 'button', class: 'main' }, text)
      button.addEventListener('click', () => this.on.act(step.name, number))
      return button
    })
    const links = [...step.variants, { text: 'Start this step again', query: step.query }].map(({ text, query }) =>
      make('a', { href: address(step.name, query), 'data-step': step.name }, text))
    this.deeds = buttons
    this.panel.append(close, make('h3', {}, step.title), this.changed, ...step.sentences.map(text => make('p', {}, text)), make('p', { class: 'deeds' }, ...buttons, ...links))
    if (step.test) {
      this.test = new ThesisTest(step.test, seed, this.on.seed)
      this.panel.append(this.test.element)
      this.test.run()
    }
  }

  /** Says what the worlds are set up with otherwise than the open step says; its buttons need its scene and its players. */
  compare(changes, setup) {
    const own = new URLSearchParams(this.open.query)
    this.changed.hidden = changes.length === 0
    set(this.says, changes.length === 0 ? '' : `The worlds are not set up as this step says: ${changes.join('; ')}. What it says need not be so here.`)
    const canAct = setup.scene === own.get('scene') && setup.panes.length >= own.get('panes').split(',').length
    this.deeds.forEach(button => { button.disabled = !canAct })
  }
}

/** The address of a step with a set-up. */
export function address(name, query) {
  return `?step=${name}&${query}`
}

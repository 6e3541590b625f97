// The controls: everything of a set-up that a person may turn, and the link that holds it.

import { figure, make, set } from './figures.mjs'

// The sliders; their ranges are those of the set-up, which the engine tells.
const Sliders = {
  delay: { text: 'Delay', unit: 'ms', step: 5 },
  jitter: { text: 'Jitter', unit: 'ms', step: 1 },
  loss: { text: 'Loss', unit: '%', step: 1 },
  burst: { text: 'In a row', unit: '', step: 1 },
  asymmetry: { text: 'Asymmetry', unit: 'ms', step: 10 },
  clock: { text: 'Clock ahead', unit: 'ms', step: 50 },
  ahead: { text: 'Look-ahead', unit: 'ms', step: 10 },
  lag: { text: 'Local lag', unit: 'ms', step: 10 },
}
const OfLink = ['delay', 'jitter', 'loss', 'burst', 'asymmetry', 'clock']
const Speeds = ['2', '1', '0.5', '0.25', '0.1', '0.05']
const Custom = 'custom'
const Texts = { link: { [Custom]: 'own figures' } }

/** The form beside the panes. */
export class Controls {
  /**
   * @param form where it is built
   * @param on what is called: `begin(query)` for another set-up, `link(query)` for other links only, whether they can be (if not, it
   *   gives `takeBack`), `speed()`, `pause(isPaused)`, `step()`
   */
  constructor(form, on) {
    this.form = form
    this.on = on
    this.read()
    this.isPaused = false
    form.addEventListener('submit', event => event.preventDefault())
  }

  /** Takes the set-up, and the step that is open, from the address of the page. `wrong` says what is wrong with the step. */
  read() {
    this.values = new URLSearchParams(location.search.slice(1) || location.hash.slice(1))
    const steps = this.values.getAll('step')
    this.wrong = steps.length > 1 ? [`'step' is there ${steps.length} times, as ${steps.map(name => `'${name}'`).join(', ')}; once is allowed. No step is shown.`] : []
    this.step = steps.length === 1 ? steps[0] : null
    this.values.delete('step')
  }

  /** The query of what is set now. */
  get query() { return this.values.toString() }

  /** The address of the page for what is set now, to be read. */
  get address() { return `${location.pathname}?${this.step === null ? '' : `step=${this.step}&`}${decodeURIComponent(this.query)}` }

  get speed() { return Number(this.values.get('speed') ?? 1) }

  /** Builds the form for what the engine offers and has. The speed, which the engine need not know, may be another. */
  build(setup, speed = null) {
    this.setup = setup
    this.sliders = {}
    this.values = new URLSearchParams(setup.query)
    speed !== null && this.put('speed', speed)
    const focused = this.form.contains(document.activeElement) ? document.activeElement : null
    this.form.replaceChildren()
    this.heading('World')
    this.choice('scene', 'Scene', setup.scenes, setup.scene, name => this.begin('scene', name))
    this.choice('count', 'Players', ['2', '3', '4'], String(setup.panes.length), count => this.players(Number(count), setup.panes))
    this.heading('Link of each player to the host')
    this.choice('link', 'Profile', setup.links, this.values.get('link') ?? Custom, name => this.profile(name))
    this.besides = make('p', { class: 'besides' })
    this.form.append(this.besides)
    for (const name of OfLink) {
      this.range(name, value => this.link(name, value))
    }
    this.showLink()
    this.heading('What players do about it')
    this.range('ahead', value => this.begin('ahead', String(value)), 'change')
    this.range('lag', value => this.begin('lag', String(value)), 'change')
    this.tick('smooth', 'Corrections glide', (this.values.get('smooth') ?? '1') !== '0', on => this.begin('smooth', on ? '1' : '0'))
    this.heading('Time')
    this.choice('speed', 'Speed', [...new Set([...Speeds, String(this.speed)])].sort((a, b) => b - a), String(this.speed), value => this.setSpeed(value))
    const row = document.createElement('div')
    row.className = 'buttons'
    this.pauseButton = this.button(row, 'Pause', () => this.pause())
    this.button(row, 'Step', () => { this.pause(true); this.on.step() })
    this.button(row, 'Restart', () => this.on.begin(this.query))
    this.form.append(row)
    const share = document.createElement('div')
    share.className = 'buttons'
    const copy = this.button(share, 'Copy a link to this set-up', () => this.copy(copy), 'main')
    this.form.append(share)
    this.pauseButton.textContent = this.isPaused ? 'Go on' : 'Pause'
    this.pauseButton.setAttribute('aria-pressed', String(this.isPaused))
    const same = [...this.form.elements].find(one => focused?.name ? one.name === focused.name : one.textContent === focused?.textContent)
    focused && same?.focus() // who goes through the form by keys stays where they are
  }

  begin(name, value) {
    this.values.set(name, value)
    this.on.begin(this.query)
  }

  /** Chooses a profile, with its own figures; those of a person begin with what the sliders show. */
  profile(name) {
    if (name === Custom) {
      this.own()
    } else {
      OfLink.forEach(figure => this.values.delete(figure))
      this.values.set('link', name)
    }
    this.relink()
  }

  /** Another figure of the link, which is the person's own from now on. */
  link(name, value) {
    this.own()
    this.put(name, value)
    this.relink()
  }

  /** Takes the figures of the profile for the person's own. */
  own() {
    const figures = this.setup.profiles[this.values.get('link')]
    this.values.delete('link')
    figures && OfLink.forEach(name => this.put(name, figures[name]))
  }

  put(name, value) {
    value === this.setup.numbers[name].usual ? this.values.delete(name) : this.values.set(name, String(value))
  }

  relink() {
    this.on.link(this.query) && this.remember()
    this.showLink()
  }

  /** What was set could not be: takes what the engine has. The form stays, so that a slider can be pulled on. */
  takeBack(setup) {
    const { speed } = this
    this.setup = setup
    this.values = new URLSearchParams(setup.query)
    this.put('speed', speed)
  }

  /** Shows what the link is, and what a profile has that no slider shows. */
  showLink() {
    const profile = this.values.get('link') ?? Custom, besides = this.setup.profiles[profile]?.besides ?? ''
    this.form.elements.link.value = profile
    set(this.besides, besides && `It has more than the sliders show: ${besides}. Own figures are without that.`)
    this.besides.hidden = besides === ''
    OfLink.forEach(name => this.sliders[name].show())
  }

  /** The number that is set under a name. */
  number(name) {
    return this.setup.profiles[this.values.get('link')]?.[name] ?? Number(this.values.get(name) ?? this.setup.numbers[name].usual)
  }

  /** What a number may be, as the others are. */
  bounds(name) {
    const { least, most } = this.setup.numbers[name]
    return name === 'asymmetry' ? [-2 * this.number('delay'), 2 * this.number('delay')] : name === 'lag' ? [least, Math.min(most, this.number('ahead'))] : [least, most]
  }

  players(count, panes) {
    const strategies = [...panes, ...Array(4).fill('healing')].slice(0, count)
    this.begin('panes', strategies.join(','))
  }

  strategy(number, name, panes) {
    this.begin('panes', panes.map((old, n) => n === number ? name : old).join(','))
  }

  setSpeed(value) {
    this.put('speed', Number(value))
    this.remember()
    this.on.speed()
  }

  pause(isPaused = !this.isPaused) {
    this.isPaused = isPaused
    this.pauseButton.textContent = isPaused ? 'Go on' : 'Pause'
    this.pauseButton.setAttribute('aria-pressed', String(isPaused))
    this.on.pause(isPaused)
  }

  /** The address of the page holds the set-up, so that it can be sent, and stays when it is loaded again. */
  remember() {
    history.replaceState(null, '', this.address)
  }

  async copy(button) {
    const text = button.textContent
    try {
      await navigator.clipboard.writeText(new URL(this.address, location.href).href)
      button.textContent = 'Copied'
    } catch {
      this.remember()
      button.textContent = 'It is the address of this page'
    }
    setTimeout(() => { button.textContent = text }, 2000)
  }

  heading(text) {
    const heading = document.createElement('h2')
    heading.textContent = text
    this.form.append(heading)
  }

  choice(name, text, options, value, changed) {
    const label = document.createElement('label')
    label.className = 'wide'
    label.textContent = text
    const select = document.createElement('select')
    select.name = name
    for (const option of options) {
      select.add(new Option(name === 'speed' ? `${option} ×` : Texts[name]?.[option] ?? option, option, false, option === value))
    }
    select.addEventListener('change', () => changed(select.value))
    label.append(select)
    this.form.append(label)
  }

  /** A slider. `when` it has changed: while it is pulled, or once it is let go, where the worlds begin anew. */
  range(name, changed, when = 'input') {
    const { text, unit, step } = Sliders[name]
    const input = make('input', { type: 'range', name }), output = make('output')
    const tell = value => {
      const words = `${figure(value)} ${unit}`.trim()
      set(output, words)
      input.setAttribute('aria-valuetext', words)
    }
    const show = () => {
      const value = this.number(name), [least, most] = this.bounds(name)
      Object.assign(input, { min: Math.min(least, value), max: Math.max(most, value) })
      input.step = Number.isInteger((value - input.min) / step) ? step : 'any' // else a browser would show another value than there is
      input.value = value
      tell(value)
    }
    const pulled = () => input.step !== 'any' ? Number(input.value)
      : Math.min(input.max, Math.max(input.min, Math.round(input.value / step) * step))
    this.sliders[name] = { show }
    input.addEventListener('input', () => tell(pulled()))
    input.addEventListener(when, () => changed(pulled()))
    this.form.append(make('label', {}, text, input, output))
    show()
  }

  tick(name, text, isOn, changed) {
    const label = document.createElement('label')
    label.className = 'tick'
    const input = document.createElement('input')
    Object.assign(input, { type: 'checkbox', name, checked: isOn })
    input.addEventListener('change', () => changed(input.checked))
    label.append(input, text)
    this.form.append(label)
  }

  button(row, text, pressed, kind = '') {
    const button = document.createElement('button')
    Object.assign(button, { type: 'button', textContent: text, className: kind })
    button.addEventListener('click', pressed)
    row.append(button)
    return button
  }
}

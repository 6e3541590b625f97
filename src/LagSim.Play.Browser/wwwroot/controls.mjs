// The controls: everything of a set-up that a person may turn, and the link that holds it.

const Ranges = {
  delay: { text: 'Delay', unit: 'ms', min: 0, max: 500, step: 5, usual: 100 },
  jitter: { text: 'Jitter', unit: 'ms', min: 0, max: 100, step: 1, usual: 0 },
  loss: { text: 'Loss', unit: '%', min: 0, max: 40, step: 1, usual: 0 },
  burst: { text: 'In a row', unit: '', min: 1, max: 10, step: 1, usual: 1 },
  asymmetry: { text: 'Asymmetry', unit: 'ms', min: -200, max: 200, step: 10, usual: 0 },
  clock: { text: 'Clock ahead', unit: 'ms', min: -1000, max: 1000, step: 50, usual: 0 },
  ahead: { text: 'Look-ahead', unit: 'ms', min: 50, max: 1000, step: 50, usual: 100 },
  lag: { text: 'Local lag', unit: 'ms', min: 0, max: 200, step: 10, usual: 0 },
}
const OfLink = ['delay', 'jitter', 'loss', 'burst', 'asymmetry', 'clock']

/** The form beside the panes. */
export class Controls {
  /**
   * @param form where it is built
   * @param on what is called: `begin(query)` for another set-up, `link(query)` for other links only, `pause(isPaused)`, `step()`
   */
  constructor(form, on) {
    this.form = form
    this.on = on
    this.read()
    this.isPaused = false
    form.addEventListener('submit', event => event.preventDefault())
  }

  /** Takes the set-up, and the step that is open, from the address of the page. */
  read() {
    this.values = new URLSearchParams(location.search.slice(1) || location.hash.slice(1))
    this.step = this.values.get('step')
    this.values.delete('step')
  }

  /** The query of what is set now. */
  get query() { return decodeURIComponent(this.values.toString()) }

  get speed() { return Number(this.values.get('speed') ?? 1) }

  /** Builds the form for what the engine offers. */
  build(setup) {
    this.values = new URLSearchParams(setup.query)
    const focused = this.form.contains(document.activeElement) ? document.activeElement : null
    this.form.replaceChildren()
    this.heading('World')
    this.choice('scene', 'Scene', setup.scenes, setup.scene, name => this.begin('scene', name))
    this.choice('count', 'Players', ['2', '3', '4'], String(setup.panes.length), count => this.players(Number(count), setup.panes))
    this.heading('Link of each player to the host')
    this.choice('link', 'Profile', setup.links, this.values.get('link') ?? 'custom', name => this.link('link', name, 'custom'))
    for (const name of OfLink) {
      this.range(name, value => this.link(name, String(value), String(Ranges[name].usual)))
    }
    this.heading('What players do about it')
    this.range('ahead', value => this.begin('ahead', String(value)), 'change')
    this.range('lag', value => this.begin('lag', String(value)), 'change')
    this.tick('smooth', 'Corrections glide', (this.values.get('smooth') ?? '1') !== '0', on => this.begin('smooth', on ? '1' : '0'))
    this.heading('Time')
    this.choice('speed', 'Speed', ['1', '0.5', '0.25', '0.1'], this.values.get('speed') ?? '1', value => this.setSpeed(value))
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
    this.remember()
  }

  begin(name, value) {
    this.values.set(name, value)
    this.on.begin(this.query)
  }

  link(name, value, usual) {
    if (name !== 'link') {
      this.values.delete('link')
      this.form.elements.link.value = 'custom'
    }
    value === usual ? this.values.delete(name) : this.values.set(name, value)
    this.on.link(this.query)
    this.remember()
  }

  players(count, panes) {
    const strategies = [...panes, ...Array(4).fill('healing')].slice(0, count)
    this.begin('panes', strategies.join(','))
  }

  strategy(number, name, panes) {
    this.begin('panes', panes.map((old, n) => n === number ? name : old).join(','))
  }

  setSpeed(value) {
    value === '1' ? this.values.delete('speed') : this.values.set('speed', value)
    this.remember()
  }

  pause(isPaused = !this.isPaused) {
    this.isPaused = isPaused
    this.pauseButton.textContent = isPaused ? 'Go on' : 'Pause'
    this.pauseButton.setAttribute('aria-pressed', String(isPaused))
    this.on.pause(isPaused)
  }

  /** The address of the page holds the set-up, so that it can be sent, and stays when it is loaded again. */
  remember() {
    history.replaceState(null, '', `${location.pathname}?${this.step === null ? '' : `step=${this.step}&`}${this.query}`)
  }

  async copy(button) {
    const text = button.textContent
    try {
      await navigator.clipboard.writeText(location.href)
      button.textContent = 'Copied'
    } catch {
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
      select.add(new Option(name === 'speed' ? `${option} ×` : option, option, false, option === value))
    }
    select.addEventListener('change', () => changed(select.value))
    label.append(select)
    this.form.append(label)
  }

  /** A slider. `when` it has changed: while it is pulled, or once it is let go, where the worlds begin anew. */
  range(name, changed, when = 'input') {
    const { text, unit, min, max, step, usual } = Ranges[name]
    const label = document.createElement('label')
    label.append(text)
    const input = document.createElement('input')
    const value = Number(this.values.get(name) ?? usual)
    Object.assign(input, { type: 'range', name, min: Math.min(min, value), max: Math.max(max, value), step, value })
    const output = document.createElement('output')
    const show = () => { output.textContent = `${input.value} ${unit}`.trim() }
    show()
    input.addEventListener('input', show)
    input.addEventListener(when, () => changed(Number(input.value)))
    label.append(input, output)
    this.form.append(label)
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

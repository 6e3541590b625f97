// The thesis's tests beside the worlds: a worker runs them, and their figures fill a table and a chart as they come.
import { chart } from './chart.mjs'
import { make, measured, set, short } from './figures.mjs'

const of = (key, format = measured) => ({ key, format })
const count = number => number.toFixed(0)
const Millimetres = 1000

const Tests = {
  drop: {
    command: 'lagsim drop --time virtual --strategy all',
    head: ['strategy', 'apart, until the news is there', 'apart, after', 'rms', 'settled samples that differ', 'heals', 'late', 'hash of all events'],
    isRow: run => run.case === 'teleport',
    name: (run, number) => number === 1 ? [run.strategy, ' ', make('small', {}, 'after a fall')] : [run.strategy],
    cells: [
      of('seen.during.max_m'), of('seen.after.max_m'), of('seen.after.rms_m'), [of('settled.after.differing_bits', count), ' of ', of('settled.after.samples', count)],
      of('heals', count), of('event_lateness_ms.max', milliseconds),
    ],
  },
  hold: {
    command: 'lagsim hold --time virtual',
    head: ['delay', 'drawn off by, rms', 'at most', 'simulated, rms', 'last known place, rms', 'settled samples that differ', 'heals', 'late', 'keyframes/s', 'hash of all events'],
    isRow: () => true,
    name: run => [make('data', { value: run.delay_ms, 'data-key': 'delay_ms' }, `${run.delay_ms} ms`)],
    cells: [
      of('held_error.0.predicted.rms_m'), of('held_error.0.predicted.max_m'), of('held_error.0.simulated.rms_m'), of('held_error.0.hold_last_m'),
      [of('settled.after.differing_bits', count), ' of ', of('settled.after.samples', count)],
      of('heals', count), of('event_lateness_ms.max', milliseconds), of('knots_per_s', short),
    ],
  },
}

/** A test with its table; it begins by itself, and ends with `stop`. */
export class ThesisTest {
  /**
   * @param name `drop` or `hold`
   * @param seed the seed to begin with
   * @param onSeed is called with another seed that a person chose; whether it can be
   */
  constructor(name, seed, onSeed) {
    this.name = name
    this.test = Tests[name]
    this.onSeed = onSeed
    this.seed = make('input', { type: 'number', name: 'seed', min: 0, max: Number.MAX_SAFE_INTEGER, step: 1, value: seed, inputmode: 'numeric', required: '' })
    this.button = make('button', { class: 'main' })
    this.bar = make('progress', { max: 1, 'aria-label': 'How much of the test is done' })
    this.says = make('p', { role: 'status' })
    this.body = make('tbody')
    this.charts = make('div', { class: 'charts' })
    const form = make('form', { class: 'again' }, make('label', {}, 'Seed', this.seed), this.button, this.bar)
    const table = make('table', {}, make('thead', {}, make('tr', {}, ...this.test.head.map(text => make('th', { scope: 'col' }, text)))), this.body)
    this.start = make('p', { class: 'start' })
    this.command = make('code')
    this.element = make('div', { class: 'test' },
      form, this.says, make('div', { class: 'table', tabindex: 0, role: 'region', 'aria-label': 'Figures of the test' }, table), this.start, this.charts,
      make('p', { class: 'same' }, 'The same figures, to the last digit: ', this.command))
    form.addEventListener('submit', event => {
      event.preventDefault()
      this.worker ? this.stop('Stopped.') : this.onSeed(this.seed.value) && this.run()
    })
  }

  /** Runs it from the start. */
  run() {
    const seed = this.seed.value
    this.runs = []
    this.body.replaceChildren()
    this.charts.replaceChildren()
    set(this.start, '')
    set(this.command, `${this.test.command} --seed ${seed}`)
    this.bar.removeAttribute('value')
    this.bar.hidden = false
    this.element.dataset.state = 'running'
    set(this.button, 'Stop')
    set(this.says, 'Loads a runtime of its own, beside the page …')
    this.worker = new Worker(`thesis-worker.mjs?test=${this.name}&seed=${seed}`, { type: 'module' })
    this.worker.addEventListener('message', ({ data }) => this.hear(data))
    this.worker.addEventListener('error', event => this.stop(`The test could not be loaded${event.message ? `: ${event.message}` : '.'}`))
  }

  hear({ progress, run, points, done, failure }) {
    if (progress !== undefined) {
      this.bar.value = progress
      set(this.says, this.runs.length === 0 ? 'Runs …' : `Runs … ${this.runs.length} ${this.runs.length === 1 ? 'run' : 'runs'} done.`)
    } else if (run) {
      this.runs.push({ run, points })
      this.add(run, this.runs.length - 1)
      this.draw()
    } else if (done) {
      this.stop('Done.')
      this.element.dataset.state = 'done'
    } else {
      this.stop(`The test ended: ${failure}`)
    }
  }

  /** Ends it, and says why. */
  stop(why = '') {
    this.worker?.terminate()
    this.worker = null
    this.bar.hidden = true
    this.element.dataset.state = 'stopped'
    set(this.button, 'Run again')
    set(this.says, why)
  }

  add(run, number) {
    if (!this.test.isRow(run)) {
      this.start.append(
        'Before that both worlds start equal, and the ball falls from 10 m (Fig 2): they are apart by ', figure(run, number, of('seen.before.max_m')), ' at most, and ',
        figure(run, number, of('settled.before.differing_bits', count)), ' of ', figure(run, number, of('settled.before.samples', count)), ' settled samples differ.')
      return
    }
    const name = make('th', { scope: 'row' }, ...this.test.name(run, number))
    name.querySelector('data')?.setAttribute('data-run', number)
    const cells = this.test.cells.map(cell => make('td', {}, ...[cell].flat().map(part => typeof part === 'string' ? part : figure(run, number, part))))
    const hashes = run.event_hashes.map((hash, peer) => make('code', { 'data-run': number, 'data-key': `event_hashes.${peer}` }, hash))
    const same = new Set(run.event_hashes).size === 1
    const agrees = make('td', { class: same ? 'same-hash' : 'other-hash' }, ...hashes.flatMap(hash => [hash, ' ']), make('small', {}, same ? '= agree' : '≠ differ'))
    this.body.append(make('tr', {}, name, ...cells, agrees))
  }

  draw() {
    this.name === 'drop' ? this.drawDrop() : this.drawHold()
  }

  drawDrop() {
    const each = this.runs.filter(({ run }, number) => run.case === 'teleport' && number > 1)
    if (each.length === 0) {
      return
    }
    const shown = each.find(({ run }) => run.strategy === this.shown) ?? each[0]
    const select = make('select', { 'aria-label': 'The strategy that is drawn' })
    for (const { run } of each) {
      select.add(new Option(run.strategy, run.strategy, false, run === shown.run))
    }
    select.addEventListener('change', () => {
      this.shown = select.value
      this.drawDrop()
      this.charts.querySelector('select').focus()
    })
    const line = column => shown.points.map(point => [point[0], point[column]])
    this.charts.replaceChildren(
      make('label', { class: 'wide' }, 'Drawn:', select),
      chart(`Height of the ball with ${shown.run.strategy}, as both players see it`, [{ name: 'player 1', points: line(1) }, { name: 'player 2, who lifts it', points: line(2) }],
        { text: 'seconds' }, { text: 'height in m', min: 0 }),
      chart(`Distance between what both see with ${shown.run.strategy}`, [{ name: '', points: line(3) }],
        { text: 'seconds', min: shown.points[0][0], max: shown.points.at(-1)[0] }, { text: 'apart in m (no line: exactly 0)', min: 1e-6, max: 20, isLog: true }))
  }

  drawHold() {
    const line = (name, key) => ({ name, points: this.runs.map(({ run }) => [run.delay_ms, value(run, `held_error.0.${key}`) * Millimetres]) })
    this.charts.replaceChildren(chart('How far off the held ball is drawn, by delay', [
      line('drawn, by the adaptive predictor', 'predicted.rms_m'), line('as simulated', 'simulated.rms_m'),
      line('last known place', 'hold_last_m'), line('last known velocity', 'velocity_m'),
    ], { text: 'delay one way in ms', min: 0, max: 500 }, { text: 'off by in mm, rms', min: 0 }))
  }
}

/** A figure with its exact value, and where the tool's JSON has it. */
function figure(run, number, { key, format }) {
  const found = value(run, key)
  return make('data', { value: found ?? '', 'data-run': number, 'data-key': key }, found === null ? '–' : format(found))
}

function value(run, key) {
  return key.split('.').reduce((at, part) => at[part], run)
}

function milliseconds(number) {
  return number === 0 ? '0' : number < 1e-3 ? `${number.toExponential(2)} ms` : `${short(number)} ms`
}

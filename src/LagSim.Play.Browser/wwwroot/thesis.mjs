// The thesis's tests beside the worlds: a worker runs them, and their figures fill tables and charts as they come.
import { chart } from './chart.mjs'
import { make, measured, set, short } from './figures.mjs'
import { FigureTable } from './table.mjs'

const of = (key, format = measured) => ({ key, format })
const count = number => number.toFixed(0)
const Millimetres = 1000
const NewLine = null
const Settled = [
  of('settled.during.differing_bits', count), ' of ', of('settled.during.samples', count), ' on the way', NewLine,
  of('settled.after.differing_bits', count), ' of ', of('settled.after.samples', count), ' after',
]
const SettledNote = ['Settled states that differ', 'every 5 ms, what both worlds have in the end is compared to the last bit: at the instants while news of the hand was on its way, and at those after.']
const HistoryNote = ['History', 'the hash of all events from the start with their times: bounces, and what the players did.']

const Tests = {
  drop: {
    command: 'lagsim drop --time virtual --strategy all',
    caption: 'One lift, seen by two players',
    head: ['strategy', 'apart, on the way', 'apart after, at most', 'apart after, rms', 'settled states that differ', 'heals', 'late', 'history'],
    isRow: run => run.case === 'teleport',
    name: (run, number) => [`${run.strategy}, `, make('small', {}, number === 1 ? 'after a fall' : 'from rest')],
    cells: [[of('seen.during.max_m')], [of('seen.after.max_m')], [of('seen.after.rms_m')], Settled, [of('heals', count)], [of('event_lateness_ms.max', milliseconds)]],
    notes: [
      ['Apart', 'how far from each other both players see the ball, while news of the lift is on its way to player 1, and after.'],
      [SettledNote[0], SettledNote[1].replace('the hand', 'the lift')],
      HistoryNote,
      ['No state differs after, and yet the history does, with ‘latency-forward’', 'once the news is there, the ball is brought to where it belongs. But in the world of player 1 it was lifted later,'
        + ' as much as the news was late; that stays in its history, and at the instants on the way the worlds differ for good.'],
      ['After a fall', 'the lift in the world of Fig 2, where the ball has fallen before. From rest: the lift alone, in a world of its own for each strategy.'],
    ],
  },
  hold: {
    command: 'lagsim hold --time virtual',
    caption: 'A ball in a hand, seen by the other player',
    head: ['delay', 'drawn off by, rms', 'at most', 'simulated, rms', 'last known place, rms', 'settled states that differ', 'heals', 'late', 'keyframes/s', 'history'],
    isRow: () => true,
    name: (run, number) => [figure(run, number, of('delay_ms', delay))],
    cells: [
      [of('held_error.0.predicted.rms_m')], [of('held_error.0.predicted.max_m')], [of('held_error.0.simulated.rms_m')], [of('held_error.0.hold_last_m')], Settled,
      [of('heals', count)], [of('event_lateness_ms.max', milliseconds)], [of('knots_per_s', short)],
    ],
    notes: [
      ['Drawn off by', 'how far the ball is drawn from where the hand is then, by the adaptive predictor. Simulated: where the world has it. Last known place: where the last keyframe had it.'],
      SettledNote, HistoryNote,
    ],
  },
}

const Predictions = 'prediction_error_m' // where the tool's JSON has them
const Prediction = {
  caption: 'The same hand, predicted from every sample of it: rms',
  head: ['delay', 'adaptive', 'of best', 'best', 'which is', 'last place', 'velocity', 'linear'],
  notes: [
    ['Best', 'of the predictors that the adaptive one mixes, in hindsight. Of best: the error of the adaptive one as a multiple of that.'],
    ['Linear', 'of 20 samples, fitted to the other nine tenths of this very motion: more than a player can know.'],
  ],
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
    this.table = new FigureTable(this.test.caption, this.test.head, 'wide')
    this.charts = make('div', { class: 'charts' })
    this.prediction = name === 'hold' ? new FigureTable(Prediction.caption, Prediction.head, 'small') : null
    const form = make('form', { class: 'again' }, make('label', {}, 'Seed', this.seed), this.button, this.bar)
    this.start = make('p', { class: 'start' })
    this.command = make('code')
    this.element = make('div', { class: 'test' },
      form, this.says, this.table.element, notes(this.test.notes), this.start,
      make('div', { class: this.prediction ? 'beside' : '' }, ...this.prediction ? [make('div', {}, this.prediction.element, notes(Prediction.notes))] : [], this.charts),
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
    this.table.clear()
    this.prediction?.clear()
    this.predicted = 0
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

  hear({ progress, run, points, prediction, done, failure }) {
    if (progress !== undefined) {
      this.bar.value = progress
      set(this.says, this.runs.length === 0 ? 'Runs …' : `Runs … ${this.runs.length} ${this.runs.length === 1 ? 'run' : 'runs'} done.`)
    } else if (run) {
      this.runs.push({ run, points })
      this.add(run, this.runs.length - 1)
      this.draw()
    } else if (prediction) {
      this.addPrediction(prediction, this.predicted++)
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
    const hashes = run.event_hashes.map((hash, peer) => make('code', { 'data-of': 'runs', 'data-run': number, 'data-key': `event_hashes.${peer}` }, hash))
    const same = new Set(run.event_hashes).size === 1
    const history = make('span', { class: same ? 'same-hash' : 'other-hash' }, ...hashes.flatMap(hash => [hash, ' ']), make('small', {}, same ? '= the same' : '≠ not the same'))
    this.table.add(this.test.name(run, number), ...this.test.cells.map(parts => parts.map(part =>
      part === NewLine ? make('br') : typeof part === 'string' ? part : figure(run, number, part))), [history])
  }

  addPrediction(error, number) {
    const part = (key, format) => [figure(error, number, of(key, format), Predictions)]
    const best = error.best_in_hindsight_m
    this.prediction.add(part('horizon_ms', delay), part('adaptive_m'), [best === 0 ? '–' : (error.adaptive_m / best).toFixed(3)], part('best_in_hindsight_m'),
      [best === 0 ? '–' : make('span', { 'data-of': Predictions, 'data-run': number, 'data-key': 'best_in_hindsight' }, error.best_in_hindsight)],
      part('hold_last_m'), part('velocity_m'), part('linear_bound_m'))
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
function figure(run, number, { key, format }, list = 'runs') {
  const found = value(run, key)
  return make('data', { value: found ?? '', 'data-of': list, 'data-run': number, 'data-key': key }, found === null ? '–' : format(found))
}

function value(run, key) {
  return key.split('.').reduce((at, part) => at[part], run)
}

/** What the columns mean, in words. */
function notes(all) {
  return make('div', { class: 'notes' }, ...all.map(([term, text]) => make('p', {}, make('b', {}, term), `: ${text}`)))
}

function delay(number) {
  return `${number} ms`
}

function milliseconds(number) {
  return number === 0 ? '0' : number < 1e-3 ? `${number.toExponential(2)} ms` : `${short(number)} ms`
}

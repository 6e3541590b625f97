// The slider over the window of the worlds: from the oldest instant that is kept to the furthest that is precomputed.
import { make, set } from './figures.mjs'

const RunningPoints = 64 // of each path, four times a second, evenly in time
const PausedPoints = 120 // and each bounce; once, as long as nothing changes
const Every = 250 // milliseconds
const OnTheSpot = 0.005 // seconds from now that still are now

/** Says which instant the panes show, and has paths sampled where they are asked for. */
export class Scrubber {
  /**
   * @param element where it is built
   * @param on what is called: `pause()` once a person looks at another instant, whether that had to be; `goOn()` to undo it once back
   */
  constructor(element, on) {
    this.on = on
    this.offset = 0
    this.time = 0 // of the present, in seconds of the worlds
    this.hasPaused = false
    this.looked = -Infinity
    this.sampled = { key: '', at: 0, time: -Infinity } // what the paths are of
    this.flat = new Float64Array(0)
    const ticks = make('datalist', { id: 'now' }, make('option', { value: 0 }))
    this.slider = make('input', { type: 'range', name: 'instant', min: -3, max: 0, step: 0.01, value: 0, list: 'now' })
    this.output = make('output')
    this.back = make('button', { type: 'button', disabled: '' }, 'Back to now')
    this.tick = make('input', { type: 'checkbox', name: 'paths' })
    element.append(
      make('label', { class: 'instant' }, 'Instant', this.slider, ticks, this.output),
      this.back,
      make('label', { class: 'tick' }, this.tick, 'Draw paths'))
    this.slider.addEventListener('input', () => this.look(Number(this.slider.value)))
    this.back.addEventListener('click', () => this.toNow())
    this.show()
  }

  /** Whether the panes show another instant than now. */
  get isAway() { return this.offset !== 0 }

  look(offset) {
    this.offset = Math.abs(offset) < OnTheSpot ? 0 : offset
    this.hasPaused = this.on.pause() || this.hasPaused
    this.show()
  }

  /** Back to the present. */
  toNow() {
    this.hasPaused && this.on.goOn()
    this.reset()
  }

  /** As at the start: other worlds, or time goes on. */
  reset() {
    this.offset = 0
    this.hasPaused = false
    this.slider.value = 0
    this.show()
  }

  show() {
    const { offset } = this
    const text = offset === 0 ? 'now' : offset < 0 ? `${(-offset).toFixed(2)} s ago` : `in ${offset.toFixed(2)} s`
    set(this.output, text)
    this.slider.setAttribute('aria-valuetext', offset > 0 ? `${text}, precomputed` : text)
    this.back.disabled = !this.isAway
  }

  /** Keeps the ends of the slider where the window ends; and samples the paths anew if they are asked for and have changed. */
  update(engine, frame, isPaused) {
    const now = performance.now()
    if (!this.isAway && now - this.looked >= Every) {
      this.looked = now
      const [oldest, newest] = engine.Window()
      this.slider.min = Math.min(-0.01, Math.ceil(oldest * 100) / 100)
      this.slider.max = Math.max(0, Math.floor(newest * 100) / 100)
    }
    this.time = this.isAway ? this.time : frame[0]
    this.isDrawn = isPaused || this.tick.checked
    if (this.isDrawn) {
      const points = isPaused ? PausedPoints : RunningPoints
      const key = isPaused ? [this.time, ...engine.heals()].join(' ') : ''
      if (isPaused ? key !== this.sampled.key : now - this.sampled.time >= Every) {
        engine.SamplePaths(points, isPaused)
        this.sampled = { key, at: this.time, time: now }
      }
    }
  }

  /** The paths that are to be drawn, of all panes: see `Paths`; null if none are. */
  paths(bodies) {
    return this.isDrawn && this.flat.length ? new Paths(this.flat, this.time - this.sampled.at, bodies) : null
  }

  /** Takes what the engine has sampled. */
  take(view) {
    if (this.flat.length !== view.length) {
      this.flat = new Float64Array(view.length)
    }
    view.copyTo(this.flat)
  }
}

/** Sampled paths: pane by pane and body by body the number of points, then seconds from now, x and y of each. */
class Paths {
  constructor(flat, passed, bodies) {
    this.flat = flat
    this.passed = passed // seconds since they were sampled
    this.bodies = bodies
    this.starts = []
    for (let at = 0; at < flat.length; at += 1 + 3 * flat[at]) {
      this.starts.push(at)
    }
  }

  /** Draws those of a pane: what has been as a line, what is precomputed with dashes. */
  draw(context, pane, sx, sy, thin, colours) {
    for (const isFuture of [false, true]) {
      context.setLineDash(isFuture ? [4 * thin, 3 * thin] : [])
      context.strokeStyle = isFuture ? colours.future : colours.path
      context.lineWidth = isFuture ? 1.6 * thin : thin
      context.beginPath()
      for (let body = 0; body < this.bodies; body++) {
        this.trace(context, this.starts[pane * this.bodies + body], isFuture, sx, sy)
      }
      context.stroke()
    }
    context.setLineDash([])
  }

  trace(context, start, isFuture, sx, sy) {
    const { flat, passed } = this
    let isDown = false
    for (let n = 0, at = start + 1; n < flat[start]; n++, at += 3) {
      const isLater = flat[at] - passed > 0, x = flat[at + 1], y = flat[at + 2]
      if (Number.isNaN(x)) {
        isDown = false
        continue
      }
      if (isLater === isFuture || isFuture && n + 1 < flat[start] && flat[at + 3] - passed > 0) {
        isDown ? context.lineTo(sx(x), sy(y)) : context.moveTo(sx(x), sy(y))
        isDown = true
      }
    }
  }
}

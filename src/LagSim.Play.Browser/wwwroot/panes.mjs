// The panes: what each player sees, drawn on a canvas, and the hand of the person who looks.
import { AirHockeyTable } from './airhockey.mjs'
import { length, set } from './figures.mjs'
import { BodyNumbers, HeaderNumbers } from './frame.mjs'
import { drawGlow, drawTruth } from './marks.mjs'

const StripSeconds = 6
const KeyStep = 1 / 40 // of the width of the view, for each key press

/** One world as its player sees it. */
export class Pane {
  constructor(number, setup, engine, onStrategy) {
    this.number = number
    this.setup = setup
    this.engine = engine
    this.chosen = 0 // the body that keys take
    this.held = null // the hand: where it is, and how fast
    this.errors = [] // metres, one a frame
    this.traffic = []
    this.game = setup.scene === 'air-hockey' ? new AirHockeyTable(this, engine.airHockey) : null
    this.element = this.build(onStrategy)
    this.resize()
  }

  build(onStrategy) {
    const pane = document.createElement('section')
    pane.className = 'pane'
    const name = this.number === 0 ? 'Player 1 <small>host</small>' : `Player ${this.number + 1}`
    pane.innerHTML = `<header><h2>${name}</h2></header>
      <canvas tabindex="0" role="application" aria-label="World of player ${this.number + 1}"></canvas>
      <canvas class="strip" height="44" aria-hidden="true"></canvas>
      <dl class="figures">
        <div><dt>off by</dt><dd data-is="error"></dd></div>
        <div><dt>heals</dt><dd data-is="heals"></dd></div>
        <div><dt>events re-run</dt><dd data-is="events"></dd></div>
        <div><dt>bodies rewound</dt><dd data-is="bodies"></dd></div>
        <div><dt>sends</dt><dd data-is="bytes"></dd></div>
        <div><dt>receives</dt><dd data-is="received"></dd></div>
      </dl>
      <div class="agrees"><p><small>this world</small> <code></code></p><p><small>without delay</small> <code></code></p><span></span></div>`
    const select = document.createElement('select')
    select.setAttribute('aria-label', `What player ${this.number + 1} does with late events`)
    for (const name of this.setup.strategies) {
      select.add(new Option(name, name, false, name === this.setup.panes[this.number]))
    }
    select.addEventListener('change', () => onStrategy(this.number, select.value))
    pane.querySelector('header').append(select)
    this.canvas = pane.querySelector('canvas')
    this.strip = pane.querySelector('.strip')
    this.figures = Object.fromEntries([...pane.querySelectorAll('dd')].map(dd => [dd.dataset.is, dd]))
    this.agrees = pane.querySelector('.agrees')
    this.hashes = this.agrees.querySelectorAll('code')
    this.game ? this.game.build(pane, this.canvas) : this.listen()
    return pane
  }

  /** Fits the canvas to its place and the screen's pixels. */
  resize() {
    const { left, right, bottom, top } = this.setup
    const width = Math.max(200, this.canvas.clientWidth || 400)
    const height = Math.min(width * (top - bottom) / (right - left), Math.max(220, window.innerHeight * 0.42))
    const density = Math.min(2, window.devicePixelRatio || 1)
    this.canvas.style.height = `${height}px`
    this.canvas.width = width * density
    this.canvas.height = height * density
    this.strip.width = width * density
    this.strip.height = 44 * density
    this.strip.style.height = '44px'
    this.scale = Math.min(this.canvas.width / (right - left), this.canvas.height / (top - bottom))
    this.shiftX = (this.canvas.width - this.scale * (right - left)) / 2 - this.scale * left
    this.shiftY = (this.canvas.height + this.scale * (top + bottom)) / 2
  }

  toView(event) {
    const box = this.canvas.getBoundingClientRect()
    const x = (event.clientX - box.left) * this.canvas.width / box.width
    const y = (event.clientY - box.top) * this.canvas.height / box.height
    return { x: (x - this.shiftX) / this.scale, y: (this.shiftY - y) / this.scale }
  }

  listen() {
    const canvas = this.canvas
    canvas.addEventListener('pointerdown', event => {
      const at = this.toView(event)
      const reach = (event.pointerType === 'mouse' ? 12 : 24) / (this.scale / Math.min(2, window.devicePixelRatio || 1))
      if (this.engine.Grab(this.number, at.x, at.y, reach)) {
        canvas.setPointerCapture(event.pointerId)
        this.take(at)
        this.held.pointer = event.pointerId
      }
    })
    const isHand = event => this.held && this.held.pointer === event.pointerId // another finger is another matter
    canvas.addEventListener('pointermove', event => isHand(event) && this.move(this.toView(event)))
    canvas.addEventListener('pointerup', event => isHand(event) && this.release())
    canvas.addEventListener('pointercancel', event => isHand(event) && this.release(true))
    canvas.addEventListener('keydown', event => this.press(event))
    canvas.addEventListener('blur', () => this.held?.pointer === false && this.release(true))
  }

  press(event) {
    const step = (this.setup.right - this.setup.left) * KeyStep
    const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }
    const way = ways[event.key]
    if (way && this.held) {
      this.move({ x: this.held.x + way[0] * step, y: this.held.y + way[1] * step })
    } else if (way) {
      this.chosen = (this.chosen + (way[0] + way[1] > 0 ? 1 : this.setup.bodies.length - 1)) % this.setup.bodies.length
    } else if (event.key === 'Enter' && this.held) {
      this.release()
    } else if (event.key === 'Enter') {
      const at = this.placeOf(this.chosen)
      if (at && this.engine.Grab(this.number, at.x, at.y, 1e-3)) {
        this.take(at)
        this.held.pointer = false
      }
    } else if (event.key === 'Escape' && this.held) {
      this.release(true)
    } else {
      return
    }
    event.preventDefault()
  }

  take(at) {
    this.held = { ...at, vx: 0, vy: 0, track: [{ ...at, time: performance.now() }] }
    this.canvas.classList.add('holding')
  }

  move(at) {
    const { left, right, bottom, top } = this.setup
    const now = performance.now(), held = this.held
    held.x = Math.min(right, Math.max(left, at.x))
    held.y = Math.min(top, Math.max(bottom, at.y))
    held.track.push({ x: held.x, y: held.y, time: now })
    held.track = held.track.filter(point => now - point.time < 90)
  }

  release(drop = false) {
    if (this.held) {
      this.measure()
      const { vx, vy } = drop ? { vx: 0, vy: 0 } : this.held
      this.engine.Release(this.number, vx, vy)
      this.held = null
      this.canvas.classList.remove('holding')
    }
  }

  /** How fast the hand moves: over the last tenth of a second. */
  measure() {
    const held = this.held, first = held.track[0], seconds = (performance.now() - (first?.time ?? 0)) / 1000
    const isStill = !first || held.track.length < 2 || seconds < 0.008
    held.vx = isStill ? 0 : (held.x - first.x) / seconds / this.speed()
    held.vy = isStill ? 0 : (held.y - first.y) / seconds / this.speed()
    held.track = held.track.filter(point => performance.now() - point.time < 90)
  }

  /** Tells the world where the hand is, once a frame. */
  send() {
    if (this.held) {
      this.measure()
      this.engine.MoveHand(this.number, this.held.x, this.held.y, this.held.vx, this.held.vy)
    }
  }

  placeOf(body) {
    const at = this.offset + HeaderNumbers + body * BodyNumbers
    return this.frame && this.frame[at] ? { x: this.frame[at + 1], y: this.frame[at + 2] } : null
  }

  /** Where a ball is drawn on the screen, in CSS pixels. */
  placeOnScreen(body) {
    const at = this.placeOf(body), box = this.canvas.getBoundingClientRect()
    return { x: box.left + this.sx(at.x) * box.width / this.canvas.width, y: box.top + this.sy(at.y) * box.height / this.canvas.height }
  }

  /** Draws a frame of numbers, which begin for this pane at an offset; of another instant than now, if that is shown. */
  draw(frame, colours, isCalm, paths, isAway) {
    this.frame = frame
    this.offset = 1 + this.number * (HeaderNumbers + this.setup.bodies.length * BodyNumbers)
    const context = this.canvas.getContext('2d'), { width, height } = this.canvas
    context.setTransform(1, 0, 0, 1, 0, 0)
    context.clearRect(0, 0, width, height)
    this.game ? this.game.draw(context, frame, colours, isCalm) : this.drawAll(context, frame, colours, isCalm, paths)
    this.note(frame, isAway)
    this.drawStrip(colours, isAway ? frame[0] : null)
  }

  drawAll(context, frame, colours, isCalm, paths) {
    this.drawScene(context, colours)
    if (paths) {
      paths.draw(context, this.number, x => this.sx(x), y => this.sy(y), Math.max(1, this.canvas.width / 700), colours)
    }
    for (let n = 0; n < this.setup.bodies.length; n++) {
      this.drawBody(context, frame, n, colours, isCalm)
    }
  }

  drawScene(context, colours) {
    const { left, right, bottom, top } = this.setup, reach = 4 * Math.hypot(right - left, top - bottom)
    context.lineWidth = Math.max(1.5, this.canvas.width / 500)
    context.strokeStyle = colours.floor
    for (const [nx, ny, offset] of this.setup.lines) {
      context.beginPath()
      context.moveTo(this.sx(nx * offset - ny * reach), this.sy(ny * offset + nx * reach))
      context.lineTo(this.sx(nx * offset + ny * reach), this.sy(ny * offset - nx * reach))
      context.stroke()
    }
    for (const [x, y, radius] of this.setup.discs) {
      context.beginPath()
      context.arc(this.sx(x), this.sy(y), radius * this.scale, 0, 2 * Math.PI)
      context.fillStyle = colours.floor
      context.fill()
    }
  }

  drawBody(context, frame, n, colours, isCalm) {
    const at = this.offset + HeaderNumbers + n * BodyNumbers
    if (!frame[at]) {
      return
    }
    const x = this.sx(frame[at + 1]), y = this.sy(frame[at + 2]), radius = this.setup.bodies[n].radius * this.scale
    const thin = Math.max(1.5, this.canvas.width / 450)
    drawGlow(context, { x, y, radius }, frame[at + 5], thin, colours, isCalm)
    context.beginPath()
    context.arc(x, y, radius, 0, 2 * Math.PI)
    context.fillStyle = colours.ball
    context.globalAlpha = 0.85
    context.fill()
    context.globalAlpha = 1
    context.lineWidth = frame[at + 6] ? 2.5 * thin : thin
    context.strokeStyle = colours.ballEdge
    context.stroke()
    if (!frame[at + 6]) {
      drawTruth(context, { x, y, radius }, this.sx(frame[at + 3]), this.sy(frame[at + 4]), thin, colours)
    }
    if (n === this.chosen && document.activeElement === this.canvas && this.canvas.matches(':focus-visible')) {
      context.beginPath()
      context.arc(x, y, radius + 5 * thin, 0, 2 * Math.PI)
      context.strokeStyle = colours.accent
      context.lineWidth = thin
      context.stroke()
    }
  }

  note(frame, isAway) {
    const [error, heals, events, bodies, bytes, received] = frame.subarray(this.offset, this.offset + HeaderNumbers)
    this.error = error
    this.heals = heals
    set(this.figures.error, length(error))
    if (isAway) {
      return // the strip and the traffic are of what was drawn as time passed
    }
    const time = frame[0]
    this.errors.push({ time, error })
    while (this.errors.length > 1 && this.errors[0].time < time - StripSeconds) {
      this.errors.shift()
    }
    this.traffic.push({ time, bytes, received })
    while (this.traffic.length > 1 && this.traffic[0].time < time - 1) {
      this.traffic.shift()
    }
    const first = this.traffic[0], span = time - first.time
    const rate = (now, then) => span > 0.2 ? `${((now - then) / span / 1000).toFixed(1)} kB/s` : ''
    const worst = this.errors.reduce((most, point) => Math.max(most, point.error), 0)
    this.figures.error.title = `${length(worst)} at worst in the last ${StripSeconds} s`
    set(this.figures.heals, heals.toFixed(0))
    set(this.figures.events, events.toFixed(0))
    set(this.figures.bodies, bodies.toFixed(0))
    set(this.figures.bytes, rate(bytes, first.bytes))
    set(this.figures.received, rate(received, first.received))
  }

  /** How far off what was drawn was, in the last seconds. */
  drawStrip(colours, shown) {
    const context = this.strip.getContext('2d'), { width, height } = this.strip
    context.clearRect(0, 0, width, height)
    const newest = this.errors.at(-1)?.time ?? 0
    const most = Math.max(0.01, ...this.errors.map(point => point.error))
    context.beginPath()
    context.moveTo(width, height)
    for (let n = this.errors.length - 1; n >= 0; n--) {
      const { time, error } = this.errors[n]
      context.lineTo(width * (1 - (newest - time) / StripSeconds), height - (height - 6) * error / most)
    }
    context.lineTo(width * (1 - (newest - (this.errors[0]?.time ?? newest)) / StripSeconds), height)
    context.fillStyle = colours.real
    context.globalAlpha = 0.55
    context.fill()
    context.globalAlpha = 1
    context.fillStyle = colours.soft
    context.font = `${height / 4}px system-ui, sans-serif`
    context.fillText(length(most), 6, height / 3.4)
    if (shown !== null && shown <= newest) {
      context.fillStyle = colours.accent
      context.fillRect(width * (1 - (newest - shown) / StripSeconds) - 1, 0, 2, height)
    }
  }

  /** Shows the hash of this world, and whether it is that of the world without delay. */
  tell(hash, truth, at) {
    const same = hash !== '' && hash === truth
    this.isSame = hash === '' ? undefined : same
    this.agrees.classList.toggle('differs', !same)
    set(this.hashes[0], hash || '…')
    set(this.hashes[1], truth || '…')
    set(this.agrees.querySelector('span'), hash === '' ? `at ${at} s: not there yet` : same ? `agrees at ${at} s` : `differs at ${at} s`)
  }

  sx(x) { return this.shiftX + this.scale * x }

  sy(y) { return this.shiftY - this.scale * y }

  speed() { return this.engine.speed() }

  /** How it is, for the summary in words. */
  get state() { return { name: `Player ${this.number + 1}`, error: this.error, heals: this.heals, agrees: this.isSame } }
}

// Air hockey in a pane: the table as its player sees it, or who looks on; the score over it, what the rules tell, and the pointer that the
// mallet follows.
// It needs what a pane has (an element with a canvas, and how metres become pixels) and a game to ask, of whatever session.
import { set } from './figures.mjs'
import { BodyNumbers, HeaderNumbers } from './frame.mjs'
import { drawGlow, drawTruth } from './marks.mjs'

const Phases = { CountDown: 0, Play: 1, Over: 2 }
const Keys = ['W A S D', 'arrow keys']
const Presences = ['', 'not answering', 'away', 'not here yet'] // here, silent, not in the session any more, never heard of
const NamesEvery = 500 // milliseconds
const Prizes = ['+1', '»', '∩'] // a second puck, a faster puck, a shield

let own = null // the colours of the table, until the theme changes
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { own = null })

/** The table of one pane. */
export class AirHockeyTable {
  /**
   * @param pane the pane: `number`, `setup`, `offset`, `scale`, `sx`, `sy`, `toView`
   * @param game what is asked: `Measures`, `Names`, `Presences`, `Look`, `News`, `Aim`, `EndAim`, `SetBot`, `PlayAgain`
   */
  constructor(pane, game) {
    this.pane = pane
    this.game = game
    const [halfLength, halfWidth, corner, post, halfMouth, puck, toWin, players, player] = game.Measures(pane.number)
    Object.assign(this, { halfLength, halfWidth, corner, post, halfMouth, puck, toWin, players, player: player < 0 ? null : player, named: -Infinity, known: [] })
  }

  /** Puts the score over the canvas, and what the rules tell on it. */
  build(element, canvas) {
    const board = document.createElement('div')
    board.className = 'board'
    board.innerHTML = `<span class="side first"><i></i><span class="who"><bdi></bdi><em role="status"></em></span></span>
      <div class="score" role="group" aria-label="Score and time left"><b></b><small></small></div>
      <span class="side second"><span class="who"><bdi></bdi><em role="status"></em></span><i></i></span>`
    const news = document.createElement('div')
    news.className = 'news'
    news.innerHTML = '<p class="told" role="status"></p>'
    canvas.before(board, news)
    element.dataset.game = 'air-hockey'
    this.parts = {
      title: element.querySelector('h2').firstChild, sides: board.querySelectorAll('bdi'), presences: board.querySelectorAll('em'),
      score: board.querySelector('b'), clock: board.querySelector('small'), told: news.firstChild,
    }
    this.plays ? this.buildHand(canvas) : element.classList.add('looks-on')
    this.tellNames()
    canvas.removeAttribute('tabindex') // keys go to the mallets, wherever the focus is
    canvas.setAttribute('role', 'img')
    canvas.setAttribute('aria-label', this.plays ? `Table as player ${this.player + 1} sees it` : 'Table')
  }

  /** Below the table: how the mallet is moved, by whom, and once the match is over, another one. */
  buildHand(canvas) {
    const foot = document.createElement('div')
    foot.className = 'hand'
    const keys = this.player < 2 ? `<span class="keys of-keys">${Keys[this.player]}, or </span>` : ''
    foot.innerHTML = `<i class="${this.player % 2 === 0 ? 'first' : 'second'}"></i><span class="how">Player ${this.player + 1}: ${keys}drag</span>
      <button type="button" class="again" hidden>Play again</button><button type="button" class="bot" aria-pressed="false">Let a bot play</button>`
    canvas.after(foot)
    Object.assign(this.parts, { again: foot.querySelector('.again'), bot: foot.querySelector('.bot') })
    this.parts.again.addEventListener('click', () => this.game.PlayAgain(this.pane.number))
    this.parts.bot.addEventListener('click', () => this.game.SetBot(this.pane.number, this.parts.bot.getAttribute('aria-pressed') !== 'true'))
    this.listen(canvas)
  }

  /** Whether somebody plays here, and does not only look on. */
  get plays() { return this.player !== null }

  /** The mallet follows a pointer while it is down. */
  listen(canvas) {
    const aim = event => {
      const { x, y } = this.pane.toView(event)
      this.game.Aim(this.pane.number, x, y)
    }
    let hand = null
    canvas.addEventListener('pointerdown', event => {
      if (hand !== null) {
        return // another finger
      }
      hand = event.pointerId
      canvas.setPointerCapture(event.pointerId)
      canvas.classList.add('holding')
      aim(event)
    })
    canvas.addEventListener('pointermove', event => event.pointerId === hand && aim(event))
    for (const end of ['pointerup', 'pointercancel']) {
      canvas.addEventListener(end, event => {
        if (event.pointerId !== hand) {
          return
        }
        hand = null
        canvas.classList.remove('holding')
        this.game.EndAim(this.pane.number)
      })
    }
  }

  /** Draws a frame: the table, what is on it, and the numbers and words about it. */
  draw(context, frame, colours, isCalm) {
    const [left, right, phase, count, seconds, closed, bot, ...things] = this.game.Look(this.pane.number)
    const style = own ??= readColours()
    this.unit = Math.max(1.5, this.pane.canvas.width / 450)
    this.drawTable(context, style, closed)
    for (let n = 0; n < things.length; n += 3) {
      things[n] < 0 ? this.drawPuck(context, style, things[n + 1], things[n + 2]) : this.drawPrize(context, style, things[n], things[n + 1], things[n + 2])
    }
    for (let n = 0; n < this.pane.setup.bodies.length; n++) {
      this.drawBody(context, frame, n, style, colours, isCalm)
    }
    if (phase === Phases.CountDown) {
      this.drawCount(context, style, count)
    }
    this.tell(left, right, phase, seconds, bot)
  }

  /** Who plays on which side, as far as their names are known, and who is not there: whoever is away keeps the name. */
  tellNames() {
    const { title, sides, presences } = this.parts, there = this.game.Presences(this.pane.number)
    this.known = this.game.Names(this.pane.number).map((name, n) => Presences[there[n]] ? name || this.known[n] : name)
    const names = this.known.map((name, n) => name || `Player ${n + 1}`)
    const shown = this.players > 2 ? ['Left', 'Right'] : names
    shown.forEach((name, side) => {
      set(sides[side], name)
      set(presences[side], this.players > 2 ? '' : Presences[there[side]])
    })
    set(title, this.plays ? `${names[this.player]} ` : 'You look on')
  }

  tell(left, right, phase, seconds, bot) {
    const { score, clock, told, again } = this.parts, now = performance.now()
    if (now - this.named >= NamesEvery) {
      this.named = now
      this.tellNames()
    }
    set(score, `${left} : ${right}`)
    const whole = Math.max(0, Math.ceil(seconds))
    set(clock, phase === Phases.CountDown ? 'get ready' : phase === Phases.Over ? 'over' : seconds > 0 ? `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}` : 'next goal wins')
    const [sentence = '', known = ''] = this.game.News(this.pane.number)
    set(told, sentence)
    told.dataset.known = known
    if (!this.plays) {
      return
    }
    again.hidden = phase !== Phases.Over
    this.parts.bot.setAttribute('aria-pressed', String(bot === 1))
    set(this.parts.bot, bot === 1 ? 'A bot plays' : 'Let a bot play')
  }

  drawTable(context, style, closed) {
    const { pane, unit } = this, x = this.halfLength, z = this.halfWidth
    const at = (right, up) => [pane.sx(right), pane.sy(up)]
    for (const side of [0, 1]) {
      // The goal is behind the line, in the colour of whom it belongs to.
      const way = side === 0 ? -1 : 1, [x0, y0] = at(way * x, this.halfMouth), [x1, y1] = at(way * (x + 0.12), -this.halfMouth)
      context.beginPath()
      context.roundRect(Math.min(x0, x1), y0, Math.abs(x1 - x0), y1 - y0, 4 * unit)
      context.fillStyle = style.sides[side]
      context.globalAlpha = 0.25
      context.fill()
      context.globalAlpha = 1
      context.lineWidth = 1.5 * unit
      context.strokeStyle = style.sides[side]
      context.stroke()
    }
    this.outline(context)
    context.fillStyle = style.table
    context.fill()
    context.lineWidth = 3.5 * unit
    context.lineJoin = 'round'
    context.strokeStyle = style.rail
    context.stroke()
    context.lineWidth = 1.2 * unit
    context.strokeStyle = style.marking
    context.beginPath()
    context.moveTo(...at(0, z))
    context.lineTo(...at(0, -z))
    context.stroke()
    for (const [middle, radius, from, to] of [[0, 0.2, 0, 2 * Math.PI], [-x, 0.36, -Math.PI / 2, Math.PI / 2], [x, 0.36, Math.PI / 2, 1.5 * Math.PI]]) {
      context.beginPath()
      context.arc(...at(middle, 0), radius * pane.scale, from, to)
      context.stroke()
    }
    context.beginPath()
    context.arc(...at(0, 0), 2.5 * unit, 0, 2 * Math.PI)
    context.fillStyle = style.marking
    context.fill()
    for (const side of [0, 1]) {
      const way = side === 0 ? -1 : 1
      context.beginPath()
      context.moveTo(...at(way * x, this.halfMouth))
      context.lineTo(...at(way * x, -this.halfMouth))
      context.lineWidth = (closed === side ? 6 : 4) * unit
      context.strokeStyle = closed === side ? style.shield : style.table
      context.stroke()
      if (closed !== side) {
        context.setLineDash([2.5 * unit, 2.5 * unit])
        context.lineWidth = 1.2 * unit
        context.strokeStyle = style.sides[side]
        context.stroke()
        context.setLineDash([])
      }
      for (const up of [-1, 1]) {
        context.beginPath()
        context.arc(...at(way * x, up * this.halfMouth), this.post * pane.scale, 0, 2 * Math.PI)
        context.fillStyle = style.sides[side]
        context.fill()
      }
    }
  }

  /** The walls: straight ones, and in each corner two that touch its circle. */
  outline(context) {
    const { pane } = this, far = this.corner / Math.cos(Math.PI / 12)
    context.beginPath()
    for (const [right, up, turn] of [[1, 1, 0], [-1, 1, 1], [-1, -1, 2], [1, -1, 3]]) {
      for (const angle of [15, 45, 75]) {
        const way = (angle + 90 * turn) * Math.PI / 180
        context.lineTo(
          pane.sx(right * (this.halfLength - this.corner) + far * Math.cos(way)), pane.sy(up * (this.halfWidth - this.corner) + far * Math.sin(way)))
      }
    }
    context.closePath()
  }

  drawBody(context, frame, n, style, colours, isCalm) {
    const { pane, unit } = this, at = pane.offset + HeaderNumbers + n * BodyNumbers
    if (!frame[at]) {
      return
    }
    const [right, up, realRight, realUp, glow] = frame.subarray(at + 1, at + 6)
    const x = pane.sx(right), y = pane.sy(up), radius = pane.setup.bodies[n].radius * pane.scale
    drawGlow(context, { x, y, radius }, glow, unit, colours, isCalm)
    n === 0 ? this.drawPuck(context, style, right, up) : this.drawMallet(context, style, n - 1, x, y, radius)
    if (n === 0 || n - 1 !== this.player) {
      drawTruth(context, { x, y, radius }, pane.sx(realRight), pane.sy(realUp), unit, colours)
    }
  }

  drawPuck(context, style, right, up) {
    const { pane, unit } = this, radius = this.puck * pane.scale
    context.beginPath()
    context.arc(pane.sx(right), pane.sy(up), radius, 0, 2 * Math.PI)
    context.fillStyle = style.puck
    context.fill()
    context.beginPath()
    context.arc(pane.sx(right), pane.sy(up), 0.6 * radius, 0, 2 * Math.PI)
    context.strokeStyle = style.table
    context.lineWidth = unit
    context.stroke()
  }

  /** Who cannot tell the colours sees a round knob on the first side and a square one on the second, each with its number. */
  drawMallet(context, style, player, x, y, radius) {
    const { unit } = this, side = player % 2, knob = 0.56 * radius
    context.beginPath()
    context.arc(x, y, radius, 0, 2 * Math.PI)
    context.fillStyle = style.sides[side]
    context.fill()
    context.lineWidth = (player === this.player ? 2 : 1) * unit
    context.strokeStyle = player === this.player ? style.ink : style.rail
    context.stroke()
    context.beginPath()
    side === 0 ? context.arc(x, y, knob, 0, 2 * Math.PI) : context.roundRect(x - knob * 0.9, y - knob * 0.9, 1.8 * knob, 1.8 * knob, 2 * unit)
    context.fillStyle = style.table
    context.fill()
    context.fillStyle = style.ink
    context.font = `700 ${1.15 * knob}px system-ui, sans-serif`
    context.textAlign = 'center'
    context.textBaseline = 'middle'
    context.fillText(String(player + 1), x, y + 0.06 * knob)
    context.textAlign = 'start'
    context.textBaseline = 'alphabetic'
  }

  drawPrize(context, style, kind, right, up) {
    const { pane, unit } = this, x = pane.sx(right), y = pane.sy(up), radius = this.puck * pane.scale
    context.beginPath()
    for (let n = 0; n < 10; n++) {
      const reach = radius * (n % 2 ? 1 : 1.35), way = n * Math.PI / 5 - Math.PI / 2
      context.lineTo(x + reach * Math.cos(way), y + reach * Math.sin(way))
    }
    context.closePath()
    context.fillStyle = style.shield
    context.fill()
    context.lineWidth = unit
    context.strokeStyle = style.ink
    context.stroke()
    context.fillStyle = style.onShield
    context.font = `700 ${1.1 * radius}px system-ui, sans-serif`
    context.textAlign = 'center'
    context.textBaseline = 'middle'
    context.fillText(Prizes[kind], x, y)
    context.textAlign = 'start'
    context.textBaseline = 'alphabetic'
  }

  drawCount(context, style, count) {
    const { pane } = this
    context.font = `800 ${0.36 * pane.scale}px system-ui, sans-serif`
    context.textAlign = 'center'
    context.textBaseline = 'middle'
    context.lineWidth = 5 * this.unit
    context.lineJoin = 'round'
    context.strokeStyle = style.table
    context.strokeText(String(count), pane.sx(0), pane.sy(0))
    context.fillStyle = style.ink
    context.fillText(String(count), pane.sx(0), pane.sy(0))
    context.textAlign = 'start'
    context.textBaseline = 'alphabetic'
  }
}

function readColours() {
  const style = getComputedStyle(document.documentElement), read = name => style.getPropertyValue(`--${name}`).trim()
  return {
    sides: [read('first'), read('second')], table: read('table'), rail: read('rail'), marking: read('marking'),
    puck: read('puck'), shield: read('shield'), onShield: read('on-shield'), ink: read('ink'),
  }
}

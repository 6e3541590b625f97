// One peer of this page in a host's session: what it sees, and how it stands.
import { set } from './figures.mjs'
import { BodyNumbers, HeaderNumbers } from './frame.mjs'
import { Pane } from './panes.mjs'

const MostCommits = 1000

export class JoinedPeer {
  /**
   * @param index which of this page's peers it is
   * @param exports what is asked; every call has the index first
   * @param seat keeps the pass, by which it is the same player again
   */
  constructor(index, exports, seat) {
    Object.assign(this, { index, exports, seat, commits: [], status: null, pane: null, setup: null, version: -1, game: null })
  }

  /** Steps, and takes the frame. Returns whether it has a pane now that it had not. */
  advance(seconds, frame) {
    this.pane?.send()
    const version = this.exports.Advance(this.index, seconds)
    this.frame = frame().slice()
    if (version === this.version) {
      return false
    }
    this.version = version
    const text = this.exports.Describe(this.index)
    if (!text) {
      return false
    }
    const setup = { ...JSON.parse(text), strategies: [], panes: [] }
    if (this.pane && ['scene', 'began', 'peer'].every(part => setup[part] === this.setup[part])) {
      Object.assign(this.setup, setup)
      return false
    }
    this.setup = setup
    this.build()
    return true
  }

  /** The pane takes this peer for its engine, whose only pane it is. */
  build() {
    const { exports, index } = this
    const bound = (source, names) => Object.fromEntries(names.map(name => [name, (_, ...rest) => source[name](index, ...rest)]))
    const airHockey = bound(exports.airHockey, ['Measures', 'Names', 'Presences', 'Steer', 'Aim', 'EndAim', 'SetBot', 'PlayAgain', 'Look', 'News'])
    this.game = this.setup.scene === 'air-hockey' ? airHockey : null
    this.pane = new Pane(0, this.setup, { ...bound(exports, ['Grab', 'MoveHand', 'Release']), airHockey, speed: () => 1 }, () => {})
    const title = this.pane.element.querySelector('h2')
    this.game ? title.querySelector('small').remove() : title.textContent = this.setup.scene
    this.pane.element.querySelectorAll('.agrees p')[1].remove() // the host's hash is not sent to the page, but what came of comparing is
    this.game || this.pane.canvas.setAttribute('aria-label', `The world, ${this.setup.scene}`)
  }

  /** Whether it has a mallet. */
  get plays() { return this.pane?.game?.plays === true }

  draw(colours, isCalm) {
    if (this.pane && this.frame?.length === 1 + HeaderNumbers + BodyNumbers * this.setup.bodies.length) {
      this.pane.draw(this.frame, colours, isCalm)
    }
  }

  /** Which keys move this player's mallet. */
  tellKeys(names) {
    const keys = this.pane?.element.querySelector('.keys')
    if (keys) {
      keys.textContent = `${names}, or `
    }
  }

  /** Whether it hears from the host, so that hashes are compared. */
  get isInTouch() {
    const { state, connected, here } = this.status
    return state === 'Running' && connected && !here.some(one => one.number === 0 && one.silent)
  }

  /** Shows its newest hash, and what came of holding hashes against the host's, which each second brings. */
  tell() {
    const { hash, agreed, differed, at } = this.status, agrees = this.pane?.agrees
    if (agrees) {
      agrees.classList.toggle('differs', differed > 0)
      agrees.classList.toggle('stale', differed === 0 && (agreed === 0 || !this.isInTouch))
      set(agrees.querySelector('code'), hash ?? '…')
      set(agrees.querySelector('span'), differed > 0 ? `differed from the host's ${differed} times` : !this.isInTouch ? 'not compared now'
        : agreed > 0 ? `the host's, ${agreed} times` : 'not compared yet')
      agrees.title = `at ${at.toFixed(2)} s`
    }
  }

  /** It has ended: its seat, its world and its connection are given up; what it saw last stays in its pane. */
  drop() {
    this.seat.leave()
    this.exports.Drop(this.index)
    if (this.pane) {
      this.pane.element.inert = true
    }
  }

  /** How the session stands. */
  look() {
    this.status = JSON.parse(this.exports.Status(this.index))
    this.commits.push(...this.exports.TakeCommits(this.index))
    this.commits.splice(0, Math.max(0, this.commits.length - MostCommits))
    if (this.status.pass && this.status.pass !== this.seat.pass) {
      this.seat.pass = this.status.pass
    }
    this.tell()
  }
}

// Which player this tab is: the pass of a player is kept, so that a tab that was closed and is opened again goes on as the same one.
// Two tabs of one browser are two players, so each takes a seat that no other tab holds. A tab says so once a second, because the
// browser's own locks are not there for a page that came over plain HTTP. A tab that has been hidden for minutes says it more rarely
// (browsers slow it down), and loses its seat to another tab of the same browser that joins meanwhile.
import { store } from './store.mjs'

const Seats = 16
const HeldFor = 4000 // milliseconds

export class Seat {
  constructor(host) {
    this.host = host
    this.number = Array.from({ length: Seats }, (_, n) => n).find(n => Date.now() - Number(store.read(this.held(n))) > HeldFor) ?? Seats
    this.isLeft = false
    this.hold()
    this.timer = setInterval(() => this.hold(), 1000)
    this.hidden = () => { this.isLeft = true; store.remove(this.held(this.number)) }
    this.shown = () => { this.isLeft = false }
    addEventListener('pagehide', this.hidden)
    addEventListener('pageshow', this.shown)
  }

  get pass() { return store.read(this.key(this.number)) }

  set pass(text) { store.write(this.key(this.number), text) }

  hold() { this.isLeft || store.write(this.held(this.number), String(Date.now())) }

  /** Another tab may have it. */
  leave() {
    clearInterval(this.timer)
    removeEventListener('pagehide', this.hidden)
    removeEventListener('pageshow', this.shown)
    this.hidden()
  }

  held(number) { return `${this.key(number)} held` }

  key(number) { return `lagsim ${this.host} ${number}` }
}

// Which player this tab is: the pass of a player is kept, so that a tab that was closed and is opened again goes on as the same one.
// Two tabs of one browser are two players, so each takes a seat that no other tab holds. A tab says so once a second, because the
// browser's own locks are not there for a page that came over plain HTTP.

const Seats = 16
const HeldFor = 4000 // milliseconds: a hidden tab still runs once a second

export class Seat {
  constructor(host) {
    this.host = host
    this.number = Array.from({ length: Seats }, (_, n) => n).find(n => Date.now() - Number(localStorage.getItem(this.held(n)) ?? 0) > HeldFor) ?? Seats
    this.hold()
    setInterval(() => this.hold(), 1000)
    addEventListener('pagehide', () => { this.isLeft = true; localStorage.removeItem(this.held(this.number)) })
    addEventListener('pageshow', () => { this.isLeft = false })
  }

  get pass() { return localStorage.getItem(this.key(this.number)) ?? '' }

  set pass(text) { localStorage.setItem(this.key(this.number), text) }

  hold() { this.isLeft || localStorage.setItem(this.held(this.number), String(Date.now())) }

  held(number) { return `${this.key(number)} held` }

  key(number) { return `lagsim ${this.host} ${number}` }
}

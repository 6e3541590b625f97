// Which player this tab is: the pass of a player is kept, so that a tab that was closed and is opened again goes on as the same one.
// Two tabs of one browser are two players, so each takes a seat that no other tab has. Tabs ask each other; the browser's own locks are
// not there for a page that came over plain HTTP. A hidden tab answers, too; one that does not for two seconds, because the browser has
// frozen it or its script hangs, loses its seat to another tab that joins meanwhile.
import { store } from './store.mjs'

const AnswerWithin = 200 // milliseconds
const BusyWithin = 2000 // the same, of one that has not said goodbye
const HostsKept = 8

export class Seat {
  /** Takes a seat at a host that no other tab of this browser has: the former one of this tab, or the first. */
  static async take(host, former) {
    const seat = new Seat(host)
    let within = AnswerWithin
    while (seat.number === null) {
      if (await seat.mustAskAgain(within)) {
        continue // another tab that was opened at the same time goes first
      }
      const free = seat.firstFree(former)
      if (within < BusyWithin && store.read(seat.held(free))) {
        within = BusyWithin // who sat there may be busy
      } else {
        seat.sit(free)
      }
    }
    remember(host)
    return seat
  }

  constructor(host) {
    Object.assign(this, { host, id: Math.random(), number: null, taken: new Set(), mustWait: false })
    try {
      this.channel = new BroadcastChannel(`lagsim ${host}`)
      this.channel.onmessage = ({ data }) => this.hear(data)
    } catch {
      // Tabs that keep nothing cannot tell each other either, and have no pass to share.
    }
    this.hidden = () => store.remove(this.held(this.number))
    this.shown = () => store.write(this.held(this.number), 'yes')
  }

  firstFree(former) {
    if (former !== undefined && !this.taken.has(former)) {
      return former
    }
    let number = 0
    while (this.taken.has(number)) {
      number++
    }
    return number
  }

  sit(number) {
    this.number = number
    this.shown()
    addEventListener('pagehide', this.hidden)
    addEventListener('pageshow', this.shown)
  }

  held(number) { return `lagsim ${this.host} ${number} held` }

  get pass() { return store.read(`${this.key} pass`) }

  set pass(text) { store.write(`${this.key} pass`, text) }

  /** What this player is called. */
  get name() { return store.read(`${this.key} name`) || store.read('lagsim name') }

  set name(text) {
    store.write(`${this.key} name`, text)
    store.write('lagsim name', text) // for a host that is new
  }

  get key() { return `lagsim ${this.host} ${this.number}` }

  /** Another tab may have it. */
  leave() {
    this.channel?.close()
    removeEventListener('pagehide', this.hidden)
    removeEventListener('pageshow', this.shown)
    this.hidden()
  }

  /** Asks all tabs which seats they have. Returns whether one that asks at the same time goes first. */
  async mustAskAgain(within) {
    this.taken.clear()
    this.mustWait = false
    this.channel?.postMessage({ ask: this.id })
    await new Promise(resolve => setTimeout(resolve, this.channel ? within : 0))
    return this.mustWait
  }

  hear({ ask, has, wait }) {
    if (ask !== undefined) {
      if (this.number !== null) {
        this.channel.postMessage({ has: this.number })
      } else if (this.id < ask) {
        this.channel.postMessage({ wait: ask })
      } else {
        this.mustWait = true
      }
    }
    has !== undefined && this.taken.add(has)
    this.mustWait ||= wait === this.id
  }
}

/** What is kept of hosts that were not met for long is given up: each start of one without --identity is another. */
function remember(host) {
  const hosts = [host, ...store.read('lagsim hosts').split(' ').filter(one => one && one !== host)]
  for (const gone of hosts.splice(HostsKept)) {
    store.keys().filter(key => key.startsWith(`lagsim ${gone} `)).forEach(key => store.remove(key))
  }
  store.write('lagsim hosts', hosts.join(' '))
}

// The page of a host: joins its session with one more peer, or with two where two people share a keyboard, beside native ones.
import { readColours } from './colours.mjs'
import { set as setText } from './figures.mjs'
import { JoinedPeer } from './joined.mjs'
import { SharedKeyboard } from './keyboard.mjs'
import { frame, loadRuntime } from './runtime.mjs'
import { Seat } from './seats.mjs'
import { tab } from './store.mjs'

const LookEvery = 250 // milliseconds
const IsIn = 'lagsim in', Key = 'lagsim key' // of a tab that is loaded again: the seat that it was in, and by which key
const found = id => document.getElementById(id)
const isCalm = matchMedia('(prefers-reduced-motion: reduce)')
let exports, host, last = 0, colours
const peers = []
let joined = 0, looking = 0, isLost = false, gone = null, seating = null, isEntering = false

// Of air hockey: a lone player has all keys; where two share the keyboard, each has its own.
const keyboard = new SharedKeyboard((player, x, y) => (peers[player] ?? peers[0]).game?.Steer(0, x, y))

// For scripts and tests: of the first peer, the committed states that it has told, how it stands, and where it draws a ball, in CSS pixels.
window.lagsim = {
  peers,
  get commits() { return (peers[0] ?? gone)?.commits ?? [] },
  get status() { return (peers[0] ?? gone)?.status ?? null },
  placeOnScreen: ball => peers[0].pane.placeOnScreen(ball),
}

try {
  host = await askHost()
  const { JoinExports, AirHockeyExports } = await loadRuntime()
  exports = { ...JoinExports, airHockey: AirHockeyExports }
  found('key-row').hidden = !host.needs_key
  const former = tab.read(`${IsIn} ${hostName()}`)
  seating = Seat.take(hostName(), former === '' ? undefined : Number(former))
  const seat = await seating
  found('name').value = seat.name
  found('loading').hidden = true
  found('enter').hidden = false
  found('name').focus()
  if (seat.pass && former === String(seat.number)) {
    found('key').value = tab.read(Key)
    enter() // the tab was loaded again
  }
} catch (failure) {
  found('loading').hidden = true
  say(failure.message ?? String(failure))
}

found('enter').addEventListener('submit', event => {
  event.preventDefault()
  enter()
})
found('again').addEventListener('click', () => {
  seating = Seat.take(hostName())
  found('session').hidden = found('panes').hidden = true
  found('enter').hidden = false
  found(host.needs_key ? 'key' : 'name').focus()
})
found('second').addEventListener('click', async () => {
  await once(async () => join(`${found('name').value.trim()} 2`.trim().slice(0, 24), await Seat.take(hostName())))
  offerSecond()
})
found('leave').addEventListener('click', () => exports.Leave())
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { colours = null })
new ResizeObserver(() => peers.forEach(peer => peer.pane?.resize())).observe(found('panes'))

async function askHost() {
  const answer = await fetch('session').catch(() => null)
  if (answer?.status === 421) {
    throw new Error(await answer.text())
  }
  if (!answer?.ok || !answer.headers.get('content-type')?.includes('json')) {
    throw new Error('No host serves this page, so there is no session to join. lagsim host --web serves one.')
  }
  return answer.json()
}

function hostName() { return host.fingerprint ?? location.host }

/** Does what takes a while, and not a second time meanwhile. */
async function once(what) {
  if (isEntering) {
    return
  }
  isEntering = found('second').disabled = found('enter').inert = true
  try {
    await what()
  } finally {
    isEntering = found('second').disabled = found('enter').inert = false
  }
}

/** Goes in with what stands in the form. */
function enter() { return once(goIn) }

async function goIn() {
  const seat = await seating
  seat.name = found('name').value
  if (join(found('name').value.trim(), seat)) {
    tab.write(`${IsIn} ${hostName()}`, String(seat.number))
    tab.write(Key, found('key').value)
    found('enter').hidden = found('again').hidden = true
    found('session').hidden = found('leave').hidden = false
    look()
    offerSecond()
    looking = setInterval(look, LookEvery)
    requestAnimationFrame(tick)
  }
}

/** One more peer of this page asks to be let in. Returns whether it does. */
function join(name, seat) {
  const address = new URL('session', location.href)
  address.protocol = address.protocol === 'https:' ? 'wss:' : 'ws:'
  const wrong = exports.Join(address.href, host.fingerprint ?? '', found('key').value, name, seat.pass, host.timeout_s, host.rejoin_s)
  say(wrong)
  if (!wrong) {
    peers.push(new JoinedPeer(joined++, exports, seat))
  }
  return !wrong
}

function tick(now) {
  const seconds = Math.max(0, (now - last) / 1000)
  last = now
  try {
    for (const peer of peers) {
      if (!peer.status?.end && peer.advance(seconds, () => frame)) {
        show()
      }
      peer.draw(colours ??= readColours(), isCalm.matches)
    }
  } catch (failure) {
    say(`This page cannot go on: ${failure.message ?? failure}. Load it again to come back.`)
    throw failure
  }
  if (peers.length > 0) {
    requestAnimationFrame(tick)
  }
}

/** All have left, or were ended: the form is one click away. */
function end() {
  clearInterval(looking)
  tab.remove(`${IsIn} ${hostName()}`)
  tab.remove(Key)
  peers.forEach(peer => peer.seat.leave())
  gone = peers[0]
  peers.length = 0
  keyboard.turn(false)
  found('leave').hidden = found('second').hidden = true
  found('again').hidden = false
  found('again').focus()
}

/** Two may share the keyboard where the game is one for two, as long as one of its mallets may be free. */
function offerSecond() {
  found('second').hidden = host.scene !== 'air hockey' || peers.length !== 1 || peers[0].status?.looks_on === true
}

/** A peer has a pane now that it had not. */
function show() {
  const isGame = peers.some(peer => peer.game)
  document.documentElement.dataset.scene = isGame ? 'air-hockey' : ''
  colours = null
  keyboard.turn(peers.some(peer => peer.plays))
  found('panes').replaceChildren(...peers.filter(peer => peer.pane).map(peer => peer.pane.element))
  found('panes').hidden = false
  found('panes').dataset.count = peers.length
  offerSecond()
  peers.forEach((peer, n) => {
    peer.tellKeys(peers.length === 1 ? 'W A S D or arrow keys' : ['W A S D', 'arrow keys'][n])
    peer.pane?.resize()
  })
  if (document.activeElement === document.body) {
    isGame || peers[0].pane?.canvas.focus({ preventScroll: true }) // the button that was pressed is gone
  }
}

/** How the session stands. */
function look() {
  peers.forEach(peer => peer.look())
  const { status } = peers[0]
  const is = { Joining: 'asking to be let in', Waiting: 'waiting for the others', Running: status.looks_on ? 'looking on: both mallets are taken' : `player ${status.player}`, Rejoining: 'coming back' }
  set('state', status.end ?? is[status.state] ?? status.state)
  const lost = status.connection && !status.end && status.state !== 'Running'
  if (lost || isLost) {
    say(lost ? `There is no connection to the host (${status.connection}). Trying again.` : '')
  }
  isLost = lost
  const own = peers.map(peer => peer.status.player)
  const here = JSON.stringify([status.here, own])
  if (found('here').dataset.is !== here) {
    found('here').dataset.is = here
    found('here').replaceChildren(...status.here.map(one => {
      const item = document.createElement('li'), isOwn = own.includes(one.number)
      const name = one.name || (one.number === 0 ? 'the host' : `player ${one.number}`)
      item.textContent = isOwn ? `${name} (you)` : one.silent ? `${name}, silent` : name
      item.classList.toggle('self', isOwn)
      item.classList.toggle('silent', one.silent)
      return item
    }))
  }
  if (status.looks_on) {
    offerSecond()
  }
  set('round-trip', status.round_trip_ms ? `${status.round_trip_ms.toFixed(0)} ms` : '')
  set('states', `${status.agreed} agree, ${status.differed} differ`)
  if (peers.every(peer => peer.status.end)) {
    end()
  }
}

function set(id, text) { setText(found(id), text) }

function say(sentence) {
  set('problem', sentence)
  found('problem').hidden = sentence === ''
}

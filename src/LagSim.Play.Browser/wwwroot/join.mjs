// The page of a host: joins its session with one more peer, or with two where two people share a keyboard, beside native ones.
import { readColours } from './colours.mjs'
import { set as setText } from './figures.mjs'
import { addressToSend, askHost, isOfThisMachine, NoRoom } from './hosts.mjs'
import { JoinedPeer } from './joined.mjs'
import { SharedKeyboard } from './keyboard.mjs'
import { frame, loadRuntime } from './runtime.mjs'
import { Seat } from './seats.mjs'
import { tab } from './store.mjs'

const LookEvery = 250 // milliseconds
const AskEvery = 3000 // the same: how often a host is asked again that has no room, or does not answer
const PatientFor = 1000 // the same: how long it is not told that one is still asking to be let in
const Other = 'Another host answers at this address now: the former one has ended, or was started again without its --identity. You can be in its session as a new player.'
const IsIn = 'lagsim in', Key = 'lagsim key' // of a tab that is loaded again: the seat that it was in, and by which key
const found = id => document.getElementById(id)
const isCalm = matchMedia('(prefers-reduced-motion: reduce)')
let exports, host, last = 0, colours
const peers = []
let joined = 0, looking = 0, isLost = false, gone = null, seating = null, isEntering = false
let asked = 0, wasIn = false // when it asked to be let in, and whether it was
let noRoom = '', isAsking = false // what the host says while there is no connection
let reconnections = 0, mayBeOther = false, isOther = false // whether another host may answer, and does

// Of air hockey: a lone player has all keys; where two share the keyboard, each has its own.
const keyboard = new SharedKeyboard((player, x, y) => {
  const playing = peers.filter(peer => peer.plays)
  const one = playing[player] ?? playing[0]
  one?.game.Steer(0, x, y)
})

// For scripts and tests: of the first peer, the committed states that it has told, how it stands, and where it draws a ball, in CSS pixels.
window.lagsim = {
  peers,
  get commits() { return (peers[0] ?? gone)?.commits ?? [] },
  get status() { return (peers[0] ?? gone)?.status ?? null },
  get held() { return exports.CountHeld() },
  placeOnScreen: ball => peers[0].pane.placeOnScreen(ball),
}

try {
  host = await askUntilThereIsRoom()
  const { JoinExports, AirHockeyExports } = await loadRuntime()
  exports = { ...JoinExports, airHockey: AirHockeyExports }
  document.documentElement.dataset.scene = isGame() ? 'air-hockey' : ''
  askForKey()
  const former = tab.read(`${IsIn} ${hostName()}`)
  seating = Seat.take(hostName(), former === '' ? undefined : Number(former))
  const seat = await seating
  found('name').value = seat.name
  found('loading').hidden = true
  found('enter').hidden = false
  found('name').focus()
  found('name').select()
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
  seating = Seat.take(hostName(), isOther ? undefined : gone.seat.number)
  found('session').hidden = found('panes').hidden = true
  found('panes').replaceChildren()
  found('enter').hidden = false
  found(host.needs_key ? 'key' : 'name').focus()
  isOther && enter()
})
found('second').addEventListener('click', async () => {
  await once(async () => {
    const seat = await Seat.take(hostName())
    peers.length > 0 ? join(nameOfSecond(found('name').value.trim()), seat) : seat.leave() // the session may have ended meanwhile
  })
  offerSecond()
})
found('leave').addEventListener('click', () => exports.Leave())
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { colours = null })
new ResizeObserver(() => peers.forEach(peer => peer.pane?.resize())).observe(found('panes'))

function pause() { return new Promise(resolve => setTimeout(resolve, AskEvery)) }

/** Asks who the host is, again while it says that it has no room. */
async function askUntilThereIsRoom() {
  for (;;) {
    try {
      const told = await askHost()
      say('')
      return told
    } catch (failure) {
      if (!(failure instanceof NoRoom)) {
        throw failure
      }
      say(failure.message)
      await pause()
    }
  }
}

/** A browser does not tell a page why it has no connection, but the host does. */
async function askWhy() {
  isAsking = true
  noRoom = await askHost().then(() => '', failure => failure instanceof NoRoom ? failure.message : '')
  await pause()
  isAsking = false
}

function hostName() { return host.fingerprint ?? location.host }

/** Asks again who the host is: since the page was loaded, another one may have been started. Returns whether one was; it gets no key that
 * was typed for the one before. */
async function meet() {
  const before = hostName()
  host = await askHost()
  askForKey()
  const isNew = hostName() !== before
  if (isNew) {
    found('key').value = ''
    ;(await seating).leave()
    seating = Seat.take(hostName())
  }
  return isNew
}

/** What was typed for a host before is no key of one that asks for none. */
function keyForHost() { return host.needs_key ? found('key').value : '' }

function askForKey() { found('key-row').hidden = !host.needs_key }

/** Does what takes a while, and not a second time meanwhile. */
async function once(what) {
  if (isEntering) {
    return
  }
  isEntering = found('second').disabled = found('enter').inert = true
  try {
    await what()
  } finally {
    isEntering = found('second').disabled = false
    found('enter').inert = peers.length > 0
  }
  focusWhatIsWrong()
}

/** Goes in with what stands in the form. */
function enter() { return once(goIn) }

async function goIn() {
  const name = found('name').value.trim()
  try {
    if (await meet() && !isOther) {
      return say(Other) // and goes in if it is asked once more
    }
  } catch (failure) {
    return say(failure.message)
  }
  const key = keyForHost()
  complain('name', exports.WhyNoName(name))
  complain('key', host.needs_key && key === '' ? 'This session needs a key. Ask whoever started it.' : exports.WhyNoKey(key))
  if (isWrong('name') || isWrong('key')) {
    return say('')
  }
  const seat = await seating
  seat.name = name
  if (join(name, seat)) {
    tab.write(`${IsIn} ${hostName()}`, String(seat.number))
    tab.write(Key, key)
    asked = performance.now()
    reconnections = 0
    wasIn = mayBeOther = isOther = false
    found('again').hidden = true
    found('leave').hidden = false
    set('again', 'Join again')
    look()
    offerSecond()
    looking = setInterval(look, LookEvery)
    requestAnimationFrame(tick)
  }
}

/** Says below a field of the form what is wrong with it; nothing if nothing is. */
function complain(field, sentence) {
  set(`${field}-problem`, sentence)
  found(`${field}-problem`).hidden = sentence === ''
  found(field).setAttribute('aria-invalid', String(sentence !== ''))
}

function isWrong(field) { return found(field).getAttribute('aria-invalid') === 'true' }

function focusWhatIsWrong() {
  const field = ['name', 'key'].find(isWrong)
  if (field && !found('enter').hidden && !found('enter').inert) {
    found(field).focus()
    found(field).select()
  }
}

/**
 * The name of the second of two at one keyboard. One that would be too long is left out, not cut, and so is that of somebody without a name:
 * the second is then called by its number. The hyphen joins the digit to the name: by itself it would read as a player's number, and be refused.
 */
function nameOfSecond(first) {
  const name = `${first}-2`
  return first === '' || exports.WhyNoName(name) ? '' : name
}

/** One more peer of this page asks to be let in. Returns whether it does. */
function join(name, seat) {
  const address = new URL('session', location.href)
  address.protocol = address.protocol === 'https:' ? 'wss:' : 'ws:'
  const wrong = exports.Join(address.href, host.fingerprint ?? '', keyForHost(), name, seat.pass, host.timeout_s, host.rejoin_s)
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

/** All have left, or were ended: the form is one click away. Who was not even let in has it still. */
function end() {
  clearInterval(looking)
  keyboard.turn(false) // which lifts the keys that are down
  tab.remove(`${IsIn} ${hostName()}`)
  tab.remove(Key)
  peers.forEach(peer => peer.drop())
  gone = peers[0]
  peers.length = 0
  found('enter').inert = isEntering
  found('here').replaceChildren()
  delete found('here').dataset.is
  set('round-trip', '')
  found('leave').hidden = found('second').hidden = found('waiting').hidden = true
  if (wasIn || isOther) {
    set('again', isOther ? 'Join the other host' : 'Join again')
    found('enter').hidden = true
    found('session').hidden = found('again').hidden = false
    found('again').focus()
  } else {
    stayOut(gone.status)
  }
}

/** The host has refused: what was typed stays, and why is told where it can be mended. */
function stayOut({ end, ended_by, key_wrong }) {
  seating = Seat.take(hostName(), gone.seat.number)
  found('session').hidden = true
  complain('key', key_wrong ? 'This key is wrong.' : '')
  say(key_wrong || ended_by === 'Left' ? '' : end)
  key_wrong ? focusWhatIsWrong() : found('name').focus()
}

/** After a connection has broken, the host may be another one than before. It could not prove to be the same, and this peer would ask it
 * for ever; nor is it joined unasked, since who is on the way could have put it there. */
async function checkHost() {
  mayBeOther = false
  const told = await askHost().catch(() => null)
  if (told === null) {
    await pause()
    mayBeOther = true // asks again
  } else if (told.fingerprint !== host.fingerprint && peers.length > 0) {
    isOther = true
    exports.Leave()
    look()
  }
}

/** While a host waits for others: for how many, and what brings them. */
function tellWaiting({ state, here }) {
  const needed = host.waits_for - here.filter(one => one.plays).length
  found('waiting').hidden = state !== 'Waiting' || needed <= 0
  if (!found('waiting').hidden) {
    const address = addressToSend(host), others = needed === 1 ? 'the other' : 'the others'
    set('game', host.scene)
    set('needed', needed === 1 ? 'One more player is needed.' : `${needed} more players are needed.`)
    const withKey = host.needs_key ? ', and the key' : ''
    set('send', isOfThisMachine(address) ? 'Open this address in another tab or browser on this computer:' : `Send ${others} this address${withKey}:`)
    set('address', address)
    document.querySelector('.of-two').hidden = found('second').hidden
  }
}

function isGame() { return host.scene === 'air hockey' }

/** How many of the game's two players are here: they have the first two numbers, whoever comes later looks on. */
function playing({ here }) { return here.filter(one => one.plays && one.number <= 2).length }

/** Two may share the keyboard where the game is one for two, as long as one of its mallets may be free. */
function offerSecond() {
  const status = peers[0]?.status
  found('second').hidden = !isGame() || peers.length !== 1 || !status || status.looks_on || playing(status) >= 2
}

/** A peer has a pane now that it had not. */
function show() {
  document.documentElement.dataset.scene = isGame() ? 'air-hockey' : ''
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
    isGame() || peers[0].pane?.canvas.focus({ preventScroll: true }) // the button that was pressed is gone
  }
}

/** How the session stands, in words. */
function stateOf(status) {
  const { state, player, looks_on, end, ended_by } = status
  if (isOther) {
    return Other
  }
  if (end) {
    return ended_by === 'Left' ? 'You have left.' : ended_by === 'HostEnded' ? `${end} Once it is there again, you can join again.` : end
  }
  const isFree = looks_on && playing(status) < 2
  return {
    Joining: 'asking to be let in',
    Synchronising: 'getting the world',
    Waiting: 'waiting for the others',
    Running: !looks_on ? `player ${player}` : isFree ? 'looking on. A mallet may be free: leave and join again to play' : 'looking on: both mallets are taken',
    Rejoining: 'coming back',
  }[state]
}

/** Of two players at one keyboard, one may have been refused or ended: the other plays on. */
function dropEnded() {
  for (const peer of peers.filter(one => one.status.end)) {
    peer.drop()
    peers.splice(peers.indexOf(peer), 1)
    show()
    say(`A player at this keyboard is not in the session any more: ${peer.status.end}`)
  }
}

/** How the session stands. */
function look() {
  peers.forEach(peer => peer.look())
  peers.every(peer => peer.status.end) || dropEnded()
  const { status } = peers[0]
  set('state', stateOf(status))
  wasIn ||= status.state !== 'Joining' && !status.end
  found('enter').hidden = wasIn
  found('session').hidden = !wasIn && performance.now() - asked < PatientFor
  tellWaiting(status)
  mayBeOther ||= Boolean(status.connection) || status.reconnections !== reconnections
  reconnections = status.reconnections
  if (mayBeOther && status.connected) {
    checkHost()
  }
  const lost = status.connection && !status.end && status.state !== 'Running'
  if (lost && !isAsking) {
    askWhy()
  }
  if (lost || isLost) {
    say(lost ? noRoom || 'There is no connection to the host. Trying again.' : '')
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
  offerSecond()
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

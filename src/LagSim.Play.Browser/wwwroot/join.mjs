// The page of a host: joins its session as one more peer, beside native ones, and draws the world that all share.
import { dotnet } from './_framework/dotnet.js'
import { BodyNumbers, HeaderNumbers } from './frame.mjs'
import { Pane } from './panes.mjs'
import { Seat } from './seats.mjs'

const LookEvery = 250 // milliseconds
const found = id => document.getElementById(id)
const isCalm = matchMedia('(prefers-reduced-motion: reduce)')
let exports, host, seat, pane, setup, version = -1, frame = new Float64Array(0), last = 0, colours = readColours()

// For scripts and tests: the committed states that this peer has told, how it stands, and where it draws a ball, in CSS pixels.
window.lagsim = { commits: [], status: null, placeOnScreen: ball => pane.placeOnScreen(ball) }

try {
  host = await askHost()
  const { getAssemblyExports, getConfig, setModuleImports, runMain } = await dotnet.create()
  setModuleImports('page', {
    takeFrame: view => {
      if (frame.length !== view.length) {
        frame = new Float64Array(view.length)
      }
      view.copyTo(frame)
    },
  })
  exports = (await getAssemblyExports(getConfig().mainAssemblyName)).LagSim.Play.Browser.JoinExports
  await runMain()
  found('name').value = localStorage.getItem('lagsim name') ?? ''
  found('key-row').hidden = !host.needs_key
  found('loading').hidden = true
  found('enter').hidden = false
  found('name').focus()
} catch (failure) {
  found('loading').hidden = true
  say(failure.message ?? String(failure))
}

found('enter').addEventListener('submit', event => {
  event.preventDefault()
  localStorage.setItem('lagsim name', found('name').value)
  seat ??= new Seat(host.fingerprint ?? location.host)
  join(seat.pass)
})
found('leave').addEventListener('click', () => exports.Leave())
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { colours = readColours() })
new ResizeObserver(() => pane?.resize()).observe(found('panes'))

async function askHost() {
  const answer = await fetch('session').catch(() => null)
  if (!answer?.ok || !answer.headers.get('content-type')?.includes('json')) {
    throw new Error('No host serves this page, so there is no session to join. lagsim host --web serves one.')
  }
  return answer.json()
}

function join(pass) {
  const address = new URL('session', location.href)
  address.protocol = address.protocol === 'https:' ? 'wss:' : 'ws:'
  const wrong = exports.Join(address.href, host.fingerprint ?? '', found('key').value, found('name').value.trim(), pass)
  say(wrong)
  if (!wrong) {
    found('enter').hidden = true
    found('session').hidden = false
    look()
    setInterval(look, LookEvery)
    requestAnimationFrame(tick)
  }
}

function tick(now) {
  const seconds = Math.max(0, (now - last) / 1000)
  last = now
  if (lagsim.status?.end) {
    return
  }
  pane?.send()
  const other = exports.Advance(seconds)
  if (other !== version) {
    version = other
    describe()
  }
  if (pane && frame.length === 1 + HeaderNumbers + BodyNumbers * setup.bodies.length) {
    pane.draw(frame, colours, isCalm.matches)
  }
  requestAnimationFrame(tick)
}

/** The bodies are others than before, or there were none. */
function describe() {
  const text = exports.Describe()
  if (!text) {
    return
  }
  const read = { ...JSON.parse(text), strategies: [], panes: [] }
  if (pane) {
    Object.assign(setup, read)
    return
  }
  setup = read
  pane = new Pane(0, setup, {
    Grab: (_, x, y, reach) => exports.Grab(x, y, reach),
    MoveHand: (_, x, y, vx, vy) => exports.MoveHand(x, y, vx, vy),
    Release: (_, vx, vy) => exports.Release(vx, vy),
    speed: () => 1,
  }, () => {})
  pane.element.querySelector('h2').textContent = setup.scene
  pane.canvas.setAttribute('aria-label', `The world, ${setup.scene}`)
  found('panes').replaceChildren(pane.element)
  found('panes').hidden = false
  pane.resize()
}

/** How the session stands. */
function look() {
  const status = lagsim.status = JSON.parse(exports.Status())
  lagsim.commits.push(...exports.TakeCommits())
  lagsim.commits.splice(0, Math.max(0, lagsim.commits.length - 1000))
  if (status.pass && status.pass !== seat.pass) {
    seat.pass = status.pass
  }
  const is = { Joining: 'asking to be let in', Waiting: 'waiting for the start', Running: `player ${status.player}`, Rejoining: 'coming back' }
  set('state', status.end ?? is[status.state] ?? status.state)
  say(status.connection && !status.end && status.state !== 'Running' ? `There is no connection to the host: ${status.connection}` : '')
  const here = status.here.map(one => `${one.number} ${one.name}`).join()
  if (found('here').dataset.is !== here + status.here.map(one => one.silent)) {
    found('here').dataset.is = here + status.here.map(one => one.silent)
    found('here').replaceChildren(...status.here.map(one => {
      const item = document.createElement('li')
      const name = one.name || (one.number === 0 ? 'the host' : `player ${one.number}`)
      item.textContent = one.number === status.player ? `${name} (you)` : one.silent ? `${name}, silent` : name
      item.classList.toggle('self', one.number === status.player)
      item.classList.toggle('silent', one.silent)
      return item
    }))
  }
  set('round-trip', status.round_trip_ms ? `${status.round_trip_ms.toFixed(0)} ms` : '')
  set('states', `${status.agreed} agree, ${status.differed} differ`)
  pane?.tell(status.hash ?? '', status.differed === 0 ? status.hash : '', status.at.toFixed(2))
}

function set(id, text) {
  if (found(id).textContent !== text) {
    found(id).textContent = text
  }
}

function say(sentence) {
  set('problem', sentence)
  found('problem').hidden = sentence === ''
}

function readColours() {
  const style = getComputedStyle(document.documentElement)
  const read = name => style.getPropertyValue(`--${name}`).trim()
  return { ball: read('ball'), ballEdge: read('ball-edge'), real: read('real'), glow: read('glow'), floor: read('floor'), soft: read('soft'), accent: read('accent') }
}

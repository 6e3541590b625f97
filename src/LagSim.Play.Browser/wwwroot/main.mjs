// The page: loads the worlds, lets time pass in them once a frame, and draws what each player sees.
import { readColours } from './colours.mjs'
import { Controls } from './controls.mjs'
import { SharedKeyboard } from './keyboard.mjs'
import { Pane } from './panes.mjs'
import { frame, loadRuntime } from './runtime.mjs'
import { Scrubber } from './scrubber.mjs'
import { Steps } from './steps.mjs'
import { Summary } from './summary.mjs'

const LongestFrame = 0.1 // seconds: a tab that was hidden does not catch up
const HashEvery = 0.25

const found = id => document.getElementById(id)
const isCalm = matchMedia('(prefers-reduced-motion: reduce)')
let engine, setup, steps, panes = [], last = 0, lastHash = -1, colours = readColours()

const keyboard = new SharedKeyboard((player, x, y) => {
  const pane = panes.find(one => one.game?.player === player)
  pane && engine.airHockey.Steer(pane.number, x, y)
})

const controls = new Controls(found('controls'), {
  begin,
  link,
  speed: () => say(),
  pause: isPaused => isPaused || scrubber.reset(),
  step: () => { scrubber.reset(); advance(1 / 60, 1 / 60) },
})
const scrubber = new Scrubber(found('scrubber'), {
  pause: () => !controls.isPaused && (controls.pause(true), true),
  goOn: () => controls.pause(false),
})
const summary = new Summary(found('summary'))

try {
  const { PlaygroundExports, AirHockeyExports } = await loadRuntime({ takePaths: view => scrubber.take(view) })
  engine = { ...PlaygroundExports, speed: () => controls.speed, heals: () => panes.map(pane => pane.heals), airHockey: AirHockeyExports }
  steps = new Steps(found('steps'), JSON.parse(engine.Steps()), { open: openStep, close: closeStep, restore, act, seed })
  arrive()
  found('loading').hidden = true
  requestAnimationFrame(tick)
} catch (failure) {
  found('loading').hidden = true
  say(`The worlds could not be loaded: ${failure.message ?? failure}`)
  throw failure
}

matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { colours = readColours() })
addEventListener('popstate', () => { controls.read(); arrive() })
found('panes').addEventListener('pointerdown', () => scrubber.isAway && scrubber.toNow(), true) // a hand is in the present
found('panes').addEventListener('keydown', event => event.key === 'Enter' && scrubber.isAway && scrubber.toNow(), true)
new ResizeObserver(() => panes.forEach(pane => pane.resize())).observe(found('panes'))
addEventListener('keydown', event => {
  if (event.key.toLowerCase() === 'p' && !event.ctrlKey && !event.metaKey && !/^(INPUT|SELECT)$/.test(document.activeElement.tagName)) {
    controls.pause()
  }
})

// For scripts and tests: where a pane draws a ball on the screen, in CSS pixels, and at how many seconds of the worlds that is.
window.lagsim = { placeOnScreen: (pane, ball) => panes[pane].placeOnScreen(ball), seconds: () => frame[0] }

/** Shows what the address of the page says: a set-up, and a step beside it. What in it cannot be is said, and the address left as it is. */
function arrive() {
  const wrong = [...controls.wrong]
  if (controls.step !== null && !steps.has(controls.step)) {
    wrong.push(`There is no step '${controls.step}'; there are ${steps.names.join(', ')}. No step is shown.`)
    controls.step = null
  }
  wrong.unshift(...engine.Arrive(controls.query || steps.queryOf(controls.step)))
  show()
  if (wrong.length === 0) {
    say()
    controls.remember()
  } else {
    say(...wrong, 'The address stays as it is until you change something.')
  }
  steps.show(controls.step, controls.values.get('seed') ?? '1')
  compare()
}

function openStep(name, values) {
  history.pushState(null, '', `${location.pathname}?${decodeURIComponent(values.toString())}`)
  controls.read()
  arrive()
}

function closeStep() {
  const name = controls.step
  controls.step = null
  controls.remember()
  say()
  steps.show(null)
  document.querySelector(`[data-step=${name}]`).focus()
}

function act(name, deed) {
  scrubber.isAway && scrubber.toNow()
  controls.isPaused && controls.pause(false)
  if (!engine.Act(name, deed)) {
    say('That cannot be done just now: a ball is in a hand, or there was too much at once.')
  }
}

/** The set-up of a step once more; seed and speed stay, and so does the test beside it. */
function restore(name) {
  const values = new URLSearchParams(steps.queryOf(name))
  for (const key of ['seed', 'speed'].filter(one => controls.values.has(one))) {
    values.set(key, controls.values.get(key))
  }
  begin(values.toString())
}

/** Another seed for the worlds, and for the test beside them. */
function seed(text) {
  controls.values.set('seed', text)
  return begin(controls.query)
}

/** Begins a set-up; says what is wrong with it, and goes on with the one before, if it cannot be. */
function begin(query) {
  const wrong = engine.Begin(query)
  say(wrong)
  if (wrong) {
    setup = JSON.parse(engine.Describe())
    controls.build(setup, controls.speed)
    return false
  }
  show()
  controls.remember()
  compare()
  return true
}

/** Other links, in the same worlds; whether they can be. If not, the controls show those before, which the worlds still have. */
function link(query) {
  const wrong = engine.SetLink(query)
  say(wrong)
  if (wrong) {
    setup = JSON.parse(engine.Describe())
    controls.takeBack(setup)
  }
  compare()
  return wrong === ''
}

/** Holds the worlds against the step that is open. */
function compare() {
  controls.step !== null && steps.compare(engine.Changes(controls.step), setup)
}

/** Shows the worlds that the engine has begun. */
function show() {
  setup = JSON.parse(engine.Describe())
  panes = setup.panes.map((_, number) => new Pane(number, setup, engine, (pane, name) => controls.strategy(pane, name, setup.panes)))
  document.documentElement.dataset.scene = setup.scene
  colours = readColours()
  keyboard.turn(setup.scene === 'air-hockey')
  const focused = found('panes').contains(document.activeElement) ? document.activeElement.getAttribute('aria-label') : null
  found('panes').replaceChildren(...panes.map(pane => pane.element))
  focused && found('panes').querySelector(`[aria-label="${focused}"]`)?.focus()
  found('panes').hidden = found('controls').hidden = found('scrubber').hidden = false
  scrubber.reset()
  controls.build(setup)
  panes.forEach(pane => pane.resize())
  lastHash = -1
}

/** Says sentences on what is wrong; none for nothing. */
function say(...sentences) {
  const text = sentences.join('\n')
  found('problem').textContent = text
  found('problem').hidden = text === ''
}

function tick(now) {
  const seconds = Math.min(LongestFrame, Math.max(0, (now - last) / 1000))
  last = now
  advance(controls.isPaused ? 0 : seconds * controls.speed, seconds)
  requestAnimationFrame(tick)
}

function advance(virtual, real) {
  const { isAway } = scrubber
  if (isAway) {
    engine.Scrub(scrubber.offset)
  } else {
    panes.forEach(pane => pane.send())
    engine.Advance(virtual, real)
  }
  scrubber.update(engine, frame, controls.isPaused)
  const paths = scrubber.paths(setup.bodies.length)
  panes.forEach(pane => pane.draw(frame, colours, isCalm.matches, paths, isAway))
  summary.tell(panes.map(pane => pane.state))
  if (isAway) {
    return
  }
  if (frame[0] < lastHash || frame[0] - lastHash >= HashEvery / 4) {
    lastHash = frame[0]
    const [at, ...hashes] = engine.Hashes()
    panes.forEach(pane => pane.tell(hashes[pane.number], hashes[hashes.length - 1], at))
  }
}

// What a host tells a page of its session, or why that page cannot join it. The page knows best where it was opened: of a host behind
// another server only the page has the name that people use.

/** The host has no room for another connection now, as it says itself. */
export class NoRoom extends Error {}

/** Asks the host at the page's own address. Throws a sentence where there is none, or where it would not let this page in. */
export async function askHost() {
  const answer = await fetch(`session?from=${encodeURIComponent(location.origin)}`).catch(() => null)
  if (!answer) {
    throw new Error(`No host answers at ${location.host} now.`)
  }
  if (answer.status === 503 && answer.headers.get('content-type')?.startsWith('text/plain')) {
    throw new NoRoom(await answer.text())
  }
  if (!(answer.ok || answer.status === 421) || !answer.headers.get('content-type')?.includes('json')) {
    throw new Error('No host serves this page, so there is no session to join. lagsim host --web serves one.')
  }
  const told = await answer.json()
  const why = answer.status === 421 ? ofName(told) : told.lets_in ? '' : ofOrigin()
  if (why) {
    throw new Error(why)
  }
  return told
}

/** The address to send to somebody else: that of this page, or where that is this machine's alone, the one that the host tells. */
export function addressToSend(host) {
  const here = new URL('.', location.href)
  return isOfThisMachine(here) ? host.address : here.href
}

/** Whether nobody on another machine can open an address. */
export function isOfThisMachine(address) {
  const { hostname } = new URL(address)
  return hostname === 'localhost' || hostname === '[::1]' || hostname.startsWith('127.')
}

/** The host was asked by a name that it does not know: the page's own, or one that a server between them has put in its place. */
function ofName({ problem, name, scheme, address }) {
  if (name !== location.host) {
    return `${problem} What stands between it and this page calls it so. Let that server pass on the name '${location.host}', `
      + `and start the host with --web-origin ${location.origin}; or start it with --web-origin ${location.origin} --web-origin ${scheme}://${name}.`
  }
  const instead = address ? `${isOfThisMachine(address) ? 'On its own machine, open' : 'Open'} ${address} instead. ` : ''
  return `${problem} ${instead}Started with --web-origin ${location.origin} the host would know it.`
}

/** A server between the host and this page calls it by a name that the host knows, but the page has come from elsewhere. */
function ofOrigin() {
  return `The host does not let in pages from ${location.origin}. Started with --web-origin ${location.origin} it does.`
}

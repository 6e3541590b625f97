// Runs the program of this folder in a browser: fetches the recordings of the folder that the query names, and leaves in
// `window.replayed` what the program says of them and how it ended.
import { dotnet } from './_framework/dotnet.js'

const lines = []
try {
  const say = console.log
  console.log = (...parts) => {
    lines.push(...parts.join(' ').split('\n').filter(line => line))
    say(...parts)
  }
  const folder = location.search.slice(1)
  const { runMain, Module } = await dotnet.withApplicationArguments(`/${folder}`).create()
  Module.FS_createPath('/', folder, true, true)
  for (const name of await (await fetch(`${folder}/`)).json()) {
    const file = await fetch(`${folder}/${name}`)
    if (!file.ok) {
      throw new Error(`${name} cannot be fetched: ${file.status}`)
    }
    Module.FS_createDataFile(`/${folder}`, name, new Uint8Array(await file.arrayBuffer()), true, true, true)
  }
  window.replayed = { exit: await runMain(), lines }
} catch (failure) {
  window.replayed = { exit: -1, lines: [...lines, `The page broke: ${failure.message ?? failure}`] }
}

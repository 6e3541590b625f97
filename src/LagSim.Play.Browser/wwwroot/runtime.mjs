// The runtime of the page: loads it, and takes the numbers of each frame from it.
import { dotnet } from './_framework/dotnet.js'

/** The frame that the engine gave last, as frame.mjs reads it; the memory is kept from frame to frame. */
export let frame = new Float64Array(0)

/** Loads it, with what else it may call of the page, and returns what the page may call of it. */
export async function loadRuntime(imports = {}) {
  const { getAssemblyExports, getConfig, setModuleImports, runMain } = await dotnet.create()
  setModuleImports('page', { takeFrame, ...imports })
  const exports = await getAssemblyExports(getConfig().mainAssemblyName)
  await runMain()
  return exports.LagSim.Play.Browser
}

function takeFrame(view) {
  if (frame.length !== view.length) {
    frame = new Float64Array(view.length)
  }
  view.copyTo(frame)
}

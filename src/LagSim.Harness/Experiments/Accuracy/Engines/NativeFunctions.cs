using System;
using System.Runtime.InteropServices;

namespace LagSim.Harness.Experiments.Accuracy.Engines;

/// <summary>An optional shared library, loaded on demand.</summary>
internal sealed class NativeFunctions
{
    private readonly nint handle;

    /// <summary>Tries the names one after the other.</summary>
    internal NativeFunctions(params string[] names)
    {
        foreach (string name in names)
        {
            if (NativeLibrary.TryLoad(name, out handle))
            {
                return;
            }
        }
    }

    /// <summary>Whether the library was found.</summary>
    internal bool IsThere => handle != 0;

    /// <summary>Returns the address of a function; zero where the library is missing.</summary>
    /// <exception cref="EntryPointNotFoundException">The library exists but has no such function.</exception>
    internal nint Find(string function) => IsThere ? NativeLibrary.GetExport(handle, function) : 0;
}

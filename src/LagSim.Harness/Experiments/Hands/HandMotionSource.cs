using System;
using System.IO;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>The hand motion that a user names: a generated one, or a CSV file.</summary>
public static class HandMotionSource
{
    /// <summary>Finds the generated motion of a name, else reads the file.</summary>
    /// <remarks>A generated one wins; a file of the same name is reached as <c>./slow</c>.</remarks>
    /// <param name="nameOrPath"><c>slow</c>, <c>random</c>, or a file as <see cref="HandMotionFile"/> describes it.</param>
    /// <param name="seed">The seed of a generated motion.</param>
    /// <exception cref="HandMotionException">The name is no generated motion, and the file does not exist or holds no hand
    /// motion.</exception>
    public static HandMotion Load(string nameOrPath, ulong seed)
    {
        ArgumentNullException.ThrowIfNull(nameOrPath);
        if (nameOrPath is HandMotions.Slow or HandMotions.Random)
        {
            return HandMotions.Generate(nameOrPath, seed);
        }

        return File.Exists(nameOrPath)
            ? HandMotionFile.Read(nameOrPath)
            : throw new HandMotionException($"'{nameOrPath}' is neither a generated hand motion ({string.Join(", ", HandMotions.Names)}) nor a file that"
                + " exists.");
    }
}

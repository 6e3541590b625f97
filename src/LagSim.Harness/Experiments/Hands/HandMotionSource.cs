using System;
using System.IO;

namespace LagSim.Harness.Experiments.Hands;

/// <summary>What a user names as a hand's motion: a generated one, or a CSV file.</summary>
public static class HandMotionSource
{
    /// <summary>The generated motion of that name, else the one recorded in that file.</summary>
    /// <remarks>A generated one wins; a file of the same name is reached as <c>./slow</c>.</remarks>
    /// <param name="nameOrPath"><c>slow</c>, <c>random</c>, or a file as <see cref="HandMotionFile"/> describes it.</param>
    /// <param name="seed">The luck of a generated one.</param>
    /// <exception cref="HandMotionException">It is neither, or the file holds no hand motion.</exception>
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

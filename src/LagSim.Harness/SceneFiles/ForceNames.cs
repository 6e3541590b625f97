using System.Collections.Generic;
using System.Linq;
using LagSim.Scenes;

namespace LagSim.Harness.SceneFiles;

/// <summary>The names of a scene file's forces, and where its bodies use them: a body may come before the forces that it names.</summary>
internal sealed class ForceNames
{
    private const int MaxListed = 10;

    private readonly List<string> known = new();
    private readonly List<(string Name, SceneFileException Where)> used = new();

    /// <summary>A force of the scene.</summary>
    internal void Add(string name) => known.Add(name);

    /// <summary>Reads the names of the forces on a body.</summary>
    internal IReadOnlyList<string> Read(ref JsonCursor cursor)
    {
        List<string> names = new();
        cursor.EnterArray("an array of the names of forces");
        while (cursor.NextElement())
        {
            string name = cursor.String();
            if (names.Contains(name))
            {
                throw cursor.Fail($"the force {JsonFault.Quote(name)} stands here twice; each may stand once");
            }

            names.Add(name);
            used.Add((name, cursor.Fail("named here")));
        }

        return names;
    }

    /// <summary>Returns the set of these forces, once all are known.</summary>
    internal ForceSet SetOf(IReadOnlyList<string> names)
    {
        ForceSet set = ForceSet.None;
        foreach (string name in names)
        {
            int at = known.IndexOf(name);
            set |= at is >= 0 and < ForceSet.MaxForces ? ForceSet.Of(at) : ForceSet.None; // the builder refuses too many forces
        }

        return set;
    }

    /// <summary>Checks that every force that a body names is there, once all are known.</summary>
    /// <exception cref="SceneFileException">One is not; the message names where it was used.</exception>
    internal void Check()
    {
        foreach ((string name, SceneFileException where) in used)
        {
            if (!known.Contains(name))
            {
                string there = known.Count == 0 ? "it has none"
                    : $"it has {string.Join(", ", known.Take(MaxListed).Select(JsonFault.Quote))}"
                        + (known.Count > MaxListed ? $" and {known.Count - MaxListed} more" : "");
                throw new SceneFileException(
                    where.File, where.Path, where.Line, $"no force of the scene is named {JsonFault.Quote(name)}; {there}");
            }
        }
    }
}

using System.Globalization;
using System.Text;

namespace LagSim.Harness.SceneFiles;

/// <summary>The position of a reader in a JSON document. It becomes text only in an error, so it is cheap to keep.</summary>
internal sealed class JsonPath
{
    private readonly string[] keys; // the key at each depth; empty in an array, and in an object before its first
    private readonly int[] indices;

    internal JsonPath(int maxDepth)
    {
        keys = new string[maxDepth];
        indices = new int[maxDepth];
    }

    /// <summary>The number of open objects and arrays.</summary>
    internal int Depth { get; private set; }

    internal void Enter()
    {
        keys[Depth] = "";
        indices[Depth] = -1;
        Depth++;
    }

    internal void Leave() => Depth--;

    internal void AtKey(string key) => keys[Depth - 1] = key;

    internal void AtNextElement() => indices[Depth - 1]++;

    /// <summary>Returns the text, for example <c>bodies[2].radius_m</c>; empty for the document itself.</summary>
    public override string ToString()
    {
        StringBuilder path = new();
        for (int i = 0; i < Depth; i++)
        {
            if (indices[i] >= 0)
            {
                path.Append(CultureInfo.InvariantCulture, $"[{indices[i]}]");
            }
            else if (keys[i].Length > 0)
            {
                path.Append(path.Length > 0 ? "." : "").Append(keys[i]);
            }
        }

        return path.ToString();
    }
}

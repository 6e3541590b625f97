namespace LagSim.Scenes;

/// <summary>
/// Those of a scene's forces that a set names, in the scene's order: what <c>foreach</c> goes through, without an allocation.
/// </summary>
internal struct ActingForces
{
    private readonly Force[] forces;
    private uint left;
    private int next;

    internal ActingForces(Force[] forces, uint mask)
    {
        this.forces = forces;
        left = mask;
        next = 0;
    }

    /// <summary>The current force.</summary>
    public readonly Force Current => forces[next - 1];

    /// <summary>Itself.</summary>
    public readonly ActingForces GetEnumerator() => this;

    /// <summary>To the next force of the set; false where there is none.</summary>
    public bool MoveNext()
    {
        while (left != 0)
        {
            bool acts = (left & 1) != 0;
            left >>= 1;
            next++;
            if (acts)
            {
                return true;
            }
        }

        return false;
    }
}

using System;
using LagSim.Time;

namespace LagSim.Scenes;

/// <summary>A 64-bit hash of exact bits that is the same in every process, runtime and processor.</summary>
/// <remarks>
/// Not cryptographic: it finds differences, it does not resist an author of differences. Each word passes the 64-bit finaliser of SplitMix.
/// </remarks>
internal struct StableHash
{
    private ulong state;

    internal void Add(ulong word)
    {
        ulong z = (state ^ word) + 0x9E3779B97F4A7C15UL;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9UL;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBUL;
        state = (z ^ (z >> 31)) + (state << 1);
    }

    internal void Add(long word) => Add((ulong)word);

    internal void Add(SimDuration span) => Add((ulong)span.Ticks);

    internal void Add(double number) => Add(Word(number));

    // -0.0 + 0.0 is 0.0: equal numbers have equal hashes.
    internal static ulong Word(double number) => (ulong)BitConverter.DoubleToInt64Bits(number + 0.0);

    internal void Add(in Vector3D v)
    {
        Add(v.X);
        Add(v.Y);
        Add(v.Z);
    }

    internal void Add(string text)
    {
        Add((ulong)text.Length);
        foreach (char c in text)
        {
            Add((ulong)c);
        }
    }

    internal void Add(in BodySpec spec)
    {
        Add(spec.Radius);
        Add(spec.Mass);
        Add(spec.Restitution);
        Add((ulong)spec.Flight | ((ulong)spec.Forces.Mask << 8));
        Add(spec.Step);
        if (spec.Flight >= MotionLaw.ClosedForm)
        {
            Add(spec.Tolerance); // the others do not ask for it, and have the hash they always had
        }

        if (spec.Friction != 0 || spec.RollingResistance != 0)
        {
            Add(0xF81C710EUL); // as above: only where a scene asks for it
            Add(spec.Friction);
            Add(spec.RollingResistance);
        }

        if (!spec.Filter.IsDefault || spec.Tag != 0)
        {
            Add(0xF117E47A6UL); // as above
            Add(spec.Filter.Packed);
            Add(spec.Tag);
        }
    }

    internal readonly ulong Value
    {
        get
        {
            StableHash end = this;
            end.Add(0x5CE2E0F0UL);
            return end.state;
        }
    }
}

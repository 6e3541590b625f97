using System;
using System.Collections.Generic;

namespace LagSim.Rules;

/// <summary>
/// Lends versions of the state, and their pages, and takes back those that nobody keeps any more, so that no memory is asked for after a
/// while.
/// </summary>
/// <remarks>A version has the pages of the one before it where they are the same. Cost of one more: its bytes compared, and what changed copied.</remarks>
internal sealed class StateVersions
{
    private readonly Stack<StateVersion> free = new();
    private readonly Stack<StatePage> freePages = new(); // whole ones
    private readonly Stack<StatePage> freeEnds = new();
    private byte[] whole = Array.Empty<byte>(); // the bytes of the version that was asked for last
    private long wholeSerial;
    private long lastSerial;

    /// <summary>How many bytes the versions take that somebody keeps.</summary>
    internal long Bytes { get; private set; }

    /// <summary>A version of this state, kept once, with the pages that it shares with another; null if there is none.</summary>
    internal StateVersion Add(ReadOnlySpan<byte> state, StateVersion? like)
    {
        StateVersion version = free.Count > 0 ? free.Pop() : new StateVersion(this);
        version.Serial = ++lastSerial;
        version.Length = state.Length;
        version.Uses = 1;
        if (version.Pages.Length < version.PageCount)
        {
            version.Pages = new StatePage[Math.Max(version.PageCount, 2 * version.Pages.Length)];
        }

        Bytes += version.PageCount * IntPtr.Size;
        for (int page = 0; page < version.PageCount; page++)
        {
            ReadOnlySpan<byte> part = state.Slice(page * StatePage.Size, Math.Min(StatePage.Size, state.Length - (page * StatePage.Size)));
            bool isShared = page < like?.PageCount && like.Part(page).SequenceEqual(part);
            StatePage its = isShared ? like!.Pages[page] : Take(part);
            its.Uses++;
            version.Pages[page] = its;
        }

        return version;
    }

    /// <summary>Keeps a version in place of another that was kept, or of none.</summary>
    internal void Replace(ref StateVersion? kept, StateVersion? by)
    {
        if (by is not null)
        {
            by.Uses++;
        }

        if (kept is not null && --kept.Uses == 0)
        {
            Free(kept);
        }

        kept = by;
    }

    /// <summary>All bytes of a version, one after the other.</summary>
    internal ReadOnlySpan<byte> Whole(StateVersion version)
    {
        if (wholeSerial != version.Serial)
        {
            if (whole.Length < version.Length)
            {
                whole = new byte[Math.Max(version.Length, 2 * whole.Length)];
            }

            for (int page = 0; page < version.PageCount; page++)
            {
                version.Part(page).CopyTo(whole.AsSpan(page * StatePage.Size));
            }

            wholeSerial = version.Serial;
        }

        return whole.AsSpan(0, version.Length);
    }

    private StatePage Take(ReadOnlySpan<byte> part)
    {
        Stack<StatePage> of = part.Length == StatePage.Size ? freePages : freeEnds;
        StatePage page = of.Count > 0 ? of.Pop() : new StatePage();
        if (page.Bytes.Length < part.Length)
        {
            page.Bytes = new byte[part.Length];
        }

        part.CopyTo(page.Bytes);
        Bytes += page.Bytes.Length;
        return page;
    }

    private void Free(StateVersion version)
    {
        for (int page = 0; page < version.PageCount; page++)
        {
            StatePage its = version.Pages[page];
            if (--its.Uses == 0)
            {
                Bytes -= its.Bytes.Length;
                (its.Bytes.Length == StatePage.Size ? freePages : freeEnds).Push(its);
            }
        }

        Bytes -= version.PageCount * IntPtr.Size;
        free.Push(version);
    }
}

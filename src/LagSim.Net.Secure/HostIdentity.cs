using System;
using System.Collections.Generic;
using System.Globalization;
using System.Security.Cryptography;

namespace LagSim.Net.Protection;

/// <summary>A host's key pair, by which clients know that they are talking to this host and no other.</summary>
/// <remarks>
/// <para>A program that hosts again and again draws one once, keeps <see cref="ToSecretText"/> in a file that only it can read, and
/// publishes the <see cref="Fingerprint"/>. With the secret anyone can pose as this host, and read what clients said in joins that they
/// recorded; what was said in sessions stays unreadable.</para>
/// <para>A host changes its key by <see cref="ChangeKey"/>: the new identity keeps the former key for a while, by which clients that know
/// only that one join, and are told the new fingerprint (<see cref="Sessions.ClientSession.HostKeyChanged"/>).</para>
/// <para>Safe on any thread. Disposing it wipes the keys; dispose it after the sessions that use it.</para>
/// </remarks>
public sealed class HostIdentity : IDisposable
{
    /// <summary>The most former keys that an identity has.</summary>
    public const int MaxFormerKeys = 4;

    /// <summary>The longest time for which a former key is kept: 366 days.</summary>
    public static readonly TimeSpan MaxKept = TimeSpan.FromDays(366);

    private static readonly long LastSecond = DateTimeOffset.MaxValue.ToUnixTimeSeconds();

    private readonly Curve25519KeyPair keys;
    private readonly FormerHostKey[] former;

    private HostIdentity(Curve25519KeyPair keys, params FormerHostKey[] former)
    {
        this.keys = keys;
        this.former = former;
        Fingerprint = HostFingerprint.OfPublicKey(keys.PublicKey);
    }

    /// <summary>What clients know this host by.</summary>
    public HostFingerprint Fingerprint { get; }

    /// <summary>The keys it had before and keeps, the newest first; also those whose time is over.</summary>
    public IReadOnlyList<FormerHostKey> FormerKeys => former;

    internal Curve25519KeyPair Keys => keys;

    /// <summary>Draws a new identity, from the system's random numbers.</summary>
    public static HostIdentity Draw() => new(Curve25519KeyPair.Draw());

    /// <summary>Reads an identity that was kept.</summary>
    /// <param name="text">
    /// The text of <see cref="ToSecretText"/>: 64 hexadecimal digits, lower case; and for each former key a blank, 64 digits more, @, and its
    /// end in seconds since 1970.
    /// </param>
    /// <param name="identity">The identity; null if the text is none.</param>
    /// <returns>False if the text is none. Never throws.</returns>
    public static bool TryParse(string? text, out HostIdentity? identity)
    {
        identity = null;
        string[] words = text?.Split(' ') ?? [];
        if (words.Length is 0 or > 1 + MaxFormerKeys || ReadKey(words[0]) is not Curve25519KeyPair newest)
        {
            return false;
        }

        List<FormerHostKey> before = new();
        for (int n = 1; n < words.Length; n++)
        {
            string[] parts = words[n].Split('@');
            if (parts.Length != 2 || !long.TryParse(parts[1], NumberStyles.None, CultureInfo.InvariantCulture, out long until) || until > LastSecond
                || ReadKey(parts[0]) is not Curve25519KeyPair old)
            {
                newest.Dispose();
                Wipe(before);
                return false;
            }

            before.Add(new FormerHostKey(old, DateTimeOffset.FromUnixTimeSeconds(until)));
        }

        identity = new HostIdentity(newest, before.ToArray());
        return true;
    }

    /// <summary>Draws a new key, and keeps the present one, which vouches for it, and former ones whose time is not over.</summary>
    /// <remarks>
    /// Keep the new identity's <see cref="ToSecretText"/> instead of the former, and start the host with it. If the present key has been
    /// stolen, keep it for no longer than players need: who has it can pose as the host, and vouch for a key of its own, to clients that know
    /// no newer one. This object stays as it is.
    /// </remarks>
    /// <param name="keepFormer">
    /// For how long the host still answers to the present key: zero to <see cref="MaxKept"/>. With zero neither that nor earlier ones are kept.
    /// </param>
    /// <param name="now">The time; default the system's.</param>
    /// <exception cref="ArgumentOutOfRangeException">The time to keep it is out of range.</exception>
    /// <exception cref="InvalidOperationException"><see cref="MaxFormerKeys"/> former keys are kept already.</exception>
    /// <exception cref="ObjectDisposedException">The keys are wiped.</exception>
    public HostIdentity ChangeKey(TimeSpan keepFormer, DateTimeOffset? now = null)
    {
        if (keepFormer < TimeSpan.Zero || keepFormer > MaxKept)
        {
            throw new ArgumentOutOfRangeException(nameof(keepFormer), keepFormer, "A former key is kept for zero to 366 days.");
        }

        DateTimeOffset time = now ?? DateTimeOffset.UtcNow;
        List<FormerHostKey> kept = new();
        if (keepFormer > TimeSpan.Zero)
        {
            kept.Add(CopyOf(keys, DateTimeOffset.FromUnixTimeSeconds((time + keepFormer).ToUnixTimeSeconds())));
            foreach (FormerHostKey old in former)
            {
                if (old.Until > time)
                {
                    kept.Add(CopyOf(old.Keys, old.Until));
                }
            }
        }

        if (kept.Count > MaxFormerKeys)
        {
            Wipe(kept);
            throw new InvalidOperationException($"The identity keeps {MaxFormerKeys} former keys already, the most there may be: {kept[kept.Count - 1]}.");
        }

        return new HostIdentity(Curve25519KeyPair.Draw(), kept.ToArray());
    }

    /// <summary>The same key without former ones, for instance since they were stolen: clients that know only those do not join any more.</summary>
    /// <remarks>This object stays as it is.</remarks>
    /// <exception cref="ObjectDisposedException">The keys are wiped.</exception>
    public HostIdentity ForgetFormerKeys() => new(new Curve25519KeyPair(keys.PrivateKey));

    /// <summary>The private keys, for <see cref="TryParse"/>: 64 hexadecimal digits, and more for former keys. Keep it like a password.</summary>
    /// <exception cref="ObjectDisposedException">The keys are wiped.</exception>
    public string ToSecretText()
    {
        string text = HexText.Of(keys.PrivateKey);
        foreach (FormerHostKey old in former)
        {
            text += FormattableString.Invariant($" {HexText.Of(old.Keys.PrivateKey)}@{old.Until.ToUnixTimeSeconds()}");
        }

        return text;
    }

    /// <summary>The fingerprint; never the secret.</summary>
    public override string ToString() => Fingerprint.ToString();

    /// <summary>Wipes the private keys.</summary>
    public void Dispose()
    {
        keys.Dispose();
        Wipe(former);
    }

    /// <summary>The keys that prove this host at a time, the newest first.</summary>
    internal IEnumerable<Curve25519KeyPair> KeysAt(DateTimeOffset now)
    {
        yield return keys;
        foreach (FormerHostKey old in former)
        {
            if (old.Until > now)
            {
                yield return old.Keys;
            }
        }
    }

    /// <summary>A key by its number, 0 for the newest; null if there is none, or its time is over.</summary>
    internal Curve25519KeyPair? KeyAt(int number, DateTimeOffset now) =>
        number == 0 ? keys : number > 0 && number <= former.Length && former[number - 1].Until > now ? former[number - 1].Keys : null;

    /// <summary>The number of the key with a fingerprint; that of the newest if there is none.</summary>
    internal int KeyOf(HostFingerprint fingerprint, DateTimeOffset now) =>
        1 + Array.FindIndex(former, old => old.Until > now && old.Fingerprint == fingerprint);

    private static void Wipe(IEnumerable<FormerHostKey> keys)
    {
        foreach (FormerHostKey old in keys)
        {
            old.Keys.Dispose();
        }
    }

    private static FormerHostKey CopyOf(Curve25519KeyPair keys, DateTimeOffset until) => new(new Curve25519KeyPair(keys.PrivateKey), until);

    private static Curve25519KeyPair? ReadKey(string text)
    {
        Span<byte> key = stackalloc byte[Curve25519KeyPair.Bytes];
        Curve25519KeyPair? read = HexText.TryRead(text, key) ? new Curve25519KeyPair(key) : null;
        CryptographicOperations.ZeroMemory(key);
        return read;
    }
}

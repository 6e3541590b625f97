using System;
using System.Security.Cryptography;
using System.Text;

namespace LagSim.Net.Protection;

/// <summary>The key of 32 bytes that Noise mixes into a handshake, made from the text of a connect key.</summary>
internal static class PreSharedKey
{
    internal const int Bytes = Sha256.Bytes;

    /// <summary>
    /// The key of a refusal: all bytes 0, which everybody knows, so that a client with a wrong key can read why. It is no connect key's.
    /// </summary>
    internal static ReadOnlySpan<byte> OfRefusal => new byte[Bytes];

    private static ReadOnlySpan<byte> Label => "LagSim connect key"u8;

    /// <summary>HMAC-SHA-256 of a label, with the connect key in UTF-8 as the key. No key at all is a text of no characters.</summary>
    internal static void Write(string connectKey, Span<byte> destination)
    {
        byte[] text = Encoding.UTF8.GetBytes(connectKey);
        Sha256.Hmac(text, Label, default, destination);
        CryptographicOperations.ZeroMemory(text);
    }
}

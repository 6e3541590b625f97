using System;

namespace LagSim.Net.Protection;

/// <summary>An exchange of fresh keys that the client's end of a link has begun, and that the host's answer ends.</summary>
/// <remarks>For one thread. A message that cannot be read changes nothing. Disposing it wipes its keys.</remarks>
public interface IKeyExchange : IDisposable
{
    /// <summary>Reads the answer. Cost: one Diffie-Hellman agreement.</summary>
    /// <param name="answer">The host's message, <see cref="IDatagramCipher.ExchangeBytes"/> bytes.</param>
    /// <returns>The cipher with the fresh keys; null if the message is not the host's answer to this exchange. Never throws.</returns>
    IDatagramCipher? TryFinish(ReadOnlySpan<byte> answer);
}

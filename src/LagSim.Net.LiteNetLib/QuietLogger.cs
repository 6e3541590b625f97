using LiteNetLib;

namespace LagSim.Net.Carriers;

/// <summary>Keeps LiteNetLib from writing to the console, which it does for every malformed packet a stranger sends.</summary>
internal sealed class QuietLogger : INetLogger
{
    /// <inheritdoc/>
    public void WriteNet(NetLogLevel level, string str, params object[] args)
    {
        // The port counts whatever concerns a user.
    }
}

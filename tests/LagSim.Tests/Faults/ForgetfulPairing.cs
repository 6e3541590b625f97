using LagSim.Hosting;

namespace LagSim.Tests.Faults;

/// <summary>Finds nothing that has moved: what a heal moves is taken back and predicted again.</summary>
internal sealed class ForgetfulPairing<T> : NoticePairing<T>
    where T : struct, INotice<T>
{
    internal override void Pair()
    {
    }
}

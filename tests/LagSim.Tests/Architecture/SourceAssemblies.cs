using System.Reflection;
using LagSim.Cli.Output;
using LagSim.Harness.Reports;
using LagSim.Net.Carriers;
using LagSim.Net.Protection;
using LagSim.Net.Sessions;
using LagSim.Play;
using LagSim.Testing;

namespace LagSim.Tests.Architecture;

/// <summary>What is compiled from <c>src</c>.</summary>
internal static class SourceAssemblies
{
    internal static readonly Assembly[] All =
    [
        typeof(Simulation).Assembly,
        typeof(Session).Assembly,
        typeof(SessionTest).Assembly,
        typeof(NumberText).Assembly,
        typeof(Playground).Assembly,
        typeof(ExitCode).Assembly,
        typeof(LiteNetLibPort).Assembly,
        typeof(WebSocketHostPort).Assembly,
        typeof(SecureHost).Assembly,
    ];
}

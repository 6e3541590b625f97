using System.Reflection;

namespace LagSim.Cli.Output;

/// <summary>The tool's version as it was built, without the source revision.</summary>
internal static class ToolVersion
{
    internal static string Text { get; } =
        (typeof(ToolVersion).Assembly.GetCustomAttribute<AssemblyInformationalVersionAttribute>()?.InformationalVersion ?? "0").Split('+')[0];
}

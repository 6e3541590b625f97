using System.Reflection;

namespace LagSim.Cli.Output;

/// <summary>The version of the tool, without the source revision.</summary>
internal static class ToolVersion
{
    internal static string Text { get; } =
        (typeof(ToolVersion).Assembly.GetCustomAttribute<AssemblyInformationalVersionAttribute>()?.InformationalVersion ?? "0").Split('+')[0];
}

using System.Diagnostics;
using System.Linq;
using System.Text.Json;
using System.Threading.Tasks;
using Xunit;

namespace LagSim.Browser;

/// <summary>The tool, <c>lagsim</c>, as a process.</summary>
internal static class Tool
{
    /// <summary>Its program.</summary>
    internal static string Path { get; } = System.IO.Path.Combine(ServedPage.Root, "src/LagSim.Cli/bin/Release/net10.0/LagSim.Cli.dll");

    /// <summary>What a command prints as JSON.</summary>
    internal static async Task<JsonElement> JsonAsync(params string[] arguments)
    {
        ProcessStartInfo how = new("dotnet") { RedirectStandardOutput = true, RedirectStandardError = true };
        foreach (string argument in new[] { Path }.Concat(arguments).Append("--json"))
        {
            how.ArgumentList.Add(argument);
        }

        using Process process = Process.Start(how)!;
        Task<string> said = process.StandardOutput.ReadToEndAsync(), complained = process.StandardError.ReadToEndAsync();
        await process.WaitForExitAsync();
        Assert.True(process.ExitCode == 0, await complained);
        return JsonDocument.Parse(await said).RootElement;
    }
}

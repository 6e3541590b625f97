#if !WITH_PEERS // with those engines nothing is packed
using System;
using System.IO;
using System.Linq;
using System.Text.Json;
using Xunit;

namespace LagSim.Tests.Api;

/// <summary>The libraries of others that the tool ships are named, with whose they are, in a file that lies beside it.</summary>
public sealed class ThirdPartyNoticesTests
{
    private static readonly string Notices = File.ReadAllText(Path.Combine(AppContext.BaseDirectory, "THIRD-PARTY-NOTICES.txt"));

    [Fact]
    public void Tool_EveryLibraryThatItShips_IsNamedWithItsOwner()
    {
        using JsonDocument built = JsonDocument.Parse(File.ReadAllText(Path.Combine(AppContext.BaseDirectory, "LagSim.Cli.deps.json")));
        string[] shipped =
        [
            .. built.RootElement.GetProperty("targets").EnumerateObject().Single().Value.EnumerateObject()
                .Where(library => IsOfOthers(built, library.Name) && library.Value.TryGetProperty("runtime", out _))
                .Select(library => library.Name.Split('/')[0]),
        ];
        Assert.Contains("LiteNetLib", shipped);
        Assert.All(shipped, name => Assert.True(IsNamed(name), $"{name} is shipped with the tool, and THIRD-PARTY-NOTICES.txt does not say whose it is."));
        Assert.False(IsNamed("Newtonsoft.Json")); // the control
    }

    private static bool IsOfOthers(JsonDocument built, string library) =>
        built.RootElement.GetProperty("libraries").GetProperty(library).GetProperty("type").GetString() == "package";

    private static bool IsNamed(string library) => Notices.Contains($"\n{library}\nCopyright (c) ", StringComparison.Ordinal);
}
#endif

using System;
using System.IO;
using System.Linq;
using System.Reflection;
using LagSim.Net.Sessions;
using Xunit;

namespace LagSim.Tests.Api;

/// <summary>The parts of sessions know each other one way only, and stay small.</summary>
public sealed class SessionPartsTests
{
    private const int MostLines = 400;
    private const int MostFields = 15;

    private static readonly string Folder = Path.Combine(RepositoryRoot.Path, "src", "LagSim.Net", "Sessions");

    [Theory]
    [InlineData("Links", "Core", "Hosts", "Joiners")]
    [InlineData("Core", "Hosts", "Joiners")]
    [InlineData("Hosts", "Joiners")]
    [InlineData("Joiners", "Hosts")]
    public void Folder_NeverKnows(string folder, params string[] others)
    {
        string[] wrong = Directory.GetFiles(Path.Combine(Folder, folder), "*.cs")
            .Where(file => File.ReadLines(file).Any(line => others.Any(other => line == $"using LagSim.Net.Sessions.{other};")))
            .Select(file => Path.GetFileName(file)!)
            .ToArray();
        Assert.Empty(wrong);
    }

    [Fact]
    public void Files_AreShort()
    {
        string[] wrong = Directory.GetFiles(Folder, "*.cs", SearchOption.AllDirectories)
            .Where(file => File.ReadLines(file).Count() > MostLines)
            .Select(file => Path.GetFileName(file)!)
            .ToArray();
        Assert.Empty(wrong);
    }

    [Fact]
    public void Classes_HaveFewFields()
    {
        string[] wrong = typeof(Session).Assembly.GetTypes()
            .Where(type => type.IsClass && type.Namespace?.StartsWith("LagSim.Net.Sessions.", StringComparison.Ordinal) == true)
            .Where(type => type.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly)
                .Count(field => !typeof(Delegate).IsAssignableFrom(field.FieldType)) > MostFields)
            .Select(type => type.Name)
            .ToArray();
        Assert.Empty(wrong);
    }
}
